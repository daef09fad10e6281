"""The paper: its published design, our answer beside it, and a verdict on each of its numbers."""
