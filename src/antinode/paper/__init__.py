"""The paper, reproduced: its tables as numbers, one reconstructed vehicle, figures and a page.

The paper is "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater
Vehicle Considering Hydrodynamic Conditions". The data of its vehicle are lost with its figures; the
vehicle here is a reconstruction (`antinode init --example paper`) that comes near its Tables 1-5.
"""
