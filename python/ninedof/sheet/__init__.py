"""The engineering sheet of a design: what a workshop needs of its legs, joints and poses."""
