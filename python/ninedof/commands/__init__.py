"""What each command does, and how it looks on a terminal: one file a command."""

from ninedof.commands.evaluation import evaluate
from ninedof.commands.front import pareto
from ninedof.commands.optimization import optimize
from ninedof.commands.survey import atlas
from ninedof.commands.sweep import SweepOptions, sweep
from ninedof.commands.verdicts import paper
from ninedof.commands.workspace import WorkspaceOptions, workspace

__all__ = ["SweepOptions", "WorkspaceOptions", "atlas", "evaluate", "optimize", "paper", "pareto", "sweep", "workspace"]
