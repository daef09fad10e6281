"""Commands that look at a design at poses."""
