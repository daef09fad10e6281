"""Motion along a trajectory: inverse kinematics over time.

`trajectory` has the poses over time, `trajectory_file` reads them from CSV.
`follow` has the public function, `followed` its result.
"""

from ninedof.motion.follow import follow
from ninedof.motion.followed import Followed, LimitBreak
from ninedof.motion.trajectory import Trajectory

__all__ = ["Followed", "LimitBreak", "Trajectory", "follow"]
