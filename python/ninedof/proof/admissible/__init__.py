"""Sets of admissible designs: all of a box, and for which rows of a list of actuators there are any."""
