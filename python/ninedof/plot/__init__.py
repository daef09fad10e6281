"""Figures of what the functions return; only the layout is computed here.

Every figure is a `matplotlib.figure.Figure` of its own, made without pyplot: no window, no global state. A figure of
one panel draws on the axes `ax` instead where they are given, one of several in the `figure` or part of one that is
given.
"""

import os as _os
import sys as _sys
from contextlib import suppress as _suppress

# matplotlib refuses to be imported with a backend that it does not know; figures do without one.
if "matplotlib" not in _sys.modules and (_backend := _os.environ.pop("MPLBACKEND", "")):
    try:
        import matplotlib as _matplotlib
    finally:
        _os.environ["MPLBACKEND"] = _backend
    with _suppress(ValueError):
        _matplotlib.rcParams["backend"] = _backend

from ninedof.plot.admissible import admissible
from ninedof.plot.convergence import convergence
from ninedof.plot.designs.compare import compare
from ninedof.plot.designs.drawing import drawing
from ninedof.plot.designs.landscape import DesignCurves, condition_curves
from ninedof.plot.designs.poses import poses
from ninedof.plot.files import save
from ninedof.plot.front import front
from ninedof.plot.motion import motion
from ninedof.plot.region_map import region_map
from ninedof.plot.space.body import workspace_body
from ninedof.plot.space.ellipsoid import ellipsoids
from ninedof.plot.space.mechanism import Robot, mechanism, mechanisms
from ninedof.plot.sweep import atlas, sweep
from ninedof.plot.workspace import Section, certified_workspace, workspace

__all__ = [
    "DesignCurves",
    "Robot",
    "Section",
    "admissible",
    "atlas",
    "certified_workspace",
    "compare",
    "condition_curves",
    "convergence",
    "drawing",
    "ellipsoids",
    "front",
    "mechanism",
    "mechanisms",
    "motion",
    "poses",
    "region_map",
    "save",
    "sweep",
    "workspace",
    "workspace_body",
]
