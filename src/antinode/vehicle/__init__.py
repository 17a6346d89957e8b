"""The vehicle: how it moves, the forces of the water, and the beam that follows."""
