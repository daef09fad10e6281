"""Figures of given geometries, configurations and arrays; only the layout is computed here.

Every figure is a `matplotlib.figure.Figure` of its own, made without pyplot: no window, no global state.
"""

import ninedof.plot.agg  # noqa: F401, before matplotlib
from ninedof.plot.atlas import atlas
from ninedof.plot.body import workspace_body
from ninedof.plot.certified import CertifiedPanel, certified_workspace
from ninedof.plot.convergence import convergence
from ninedof.plot.dimensions import figure_5
from ninedof.plot.ellipsoid import EllipsoidPanel, ellipsoids
from ninedof.plot.files import save
from ninedof.plot.front import Sketch, front
from ninedof.plot.landscape import DesignCurves, condition_curves
from ninedof.plot.mechanism import Mechanism, draw_mechanism, mechanisms
from ninedof.plot.motion import motion
from ninedof.plot.paper_figures import figure_1, figure_2, figure_3, figure_4
from ninedof.plot.paper_sweeps import figure_6, figure_7
from ninedof.plot.pose_conditions import PoseConditions, poses
from ninedof.plot.section import Section
from ninedof.plot.sweep import sweep
from ninedof.plot.workspace import workspace

__all__ = [
    "CertifiedPanel",
    "DesignCurves",
    "EllipsoidPanel",
    "Mechanism",
    "PoseConditions",
    "Section",
    "Sketch",
    "atlas",
    "certified_workspace",
    "condition_curves",
    "convergence",
    "draw_mechanism",
    "ellipsoids",
    "figure_1",
    "figure_2",
    "figure_3",
    "figure_4",
    "figure_5",
    "figure_6",
    "figure_7",
    "front",
    "mechanisms",
    "motion",
    "poses",
    "save",
    "sweep",
    "workspace",
    "workspace_body",
]
