"""Commands that look at a machine as a whole, over all that its study asks for."""
