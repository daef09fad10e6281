"""Motion along a trajectory: inverse kinematics over time.

`trajectory` has the poses over time, `follow` the motion of the legs, `tables` its tables.
"""

from ninedof.motion.follow import Followed, LimitBreak, follow
from ninedof.motion.trajectory import Trajectory

__all__ = ["Followed", "LimitBreak", "Trajectory", "follow"]
