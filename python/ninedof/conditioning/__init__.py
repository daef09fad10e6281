"""The characteristic length and the indices of the conditioning matrix."""
