"""What each command does, and how it looks on a terminal: one file a command."""

from ninedof.cli.commands.evaluation import evaluate
from ninedof.cli.commands.front import pareto
from ninedof.cli.commands.optimization import optimize
from ninedof.cli.commands.survey import atlas
from ninedof.cli.commands.sweep import SweepOptions, sweep
from ninedof.cli.commands.verdicts import paper
from ninedof.cli.commands.workspace import WorkspaceOptions, workspace

__all__ = ["SweepOptions", "WorkspaceOptions", "atlas", "evaluate", "optimize", "paper", "pareto", "sweep", "workspace"]
