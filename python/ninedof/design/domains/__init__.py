"""Poses and regions of poses, about the neutral pose of a design."""
