"""The failure of legs."""
