"""The condition number of many poses by several packages: what bench/python/comparison.py runs.

Every method is a module with `prepare(robot, poses)`. That may compile and convert, and is not timed; it returns a
function without arguments that gives the condition numbers of the poses, and that one is.
"""
