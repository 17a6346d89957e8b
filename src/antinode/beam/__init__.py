"""The beam, the waist of the program: what every problem becomes, and all the solver needs."""
