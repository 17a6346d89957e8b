"""Files in and out: beams, modes and measurements in the formats of other programs."""
