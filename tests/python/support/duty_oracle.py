"""Forces and rates of legs in numpy, from the velocities of points for each of nine motions (turns, p, O).

Shares with the core its joints and configurations alone. `DUTY` are tables of a study with every kind of mass.
"""

import numpy as np

DUTY = {
    "loads": {"gravity": (0.4, 0.0, -9.81), "wrenches": [[0, 0, 0, 0, 0, -50], [30, -20, 5, 20, 10, -20]]},
    "masses": {
        "platform": 3.0,
        "centre": (0.1, -0.2, 0.3),
        "cylinder": 0.4,
        "rod": 0.2,
        "cylinder_centre": 0.6,
        "rod_centre": 0.5,
        "internal_point": 0.1,
    },
    "speeds": {"linear": 0.7, "angular": 0.4},
}


def _points(g, c):
    """Ends of the nine legs and their velocities for each motion, (9, 3) and (9, 3, 9) twice."""
    arms = np.vstack([g.platform_external, g.platform_internal]) @ c.rotation.T
    still, of_o = np.zeros((3, 9)), np.hstack([np.zeros((3, 6)), np.eye(3)])

    def moved(arm):
        return np.hstack([-np.cross(np.eye(3), arm), np.eye(3), np.zeros((3, 3))])  # omega x arm

    start = np.vstack([g.base_external, c.position + arms[3:], g.base_internal])
    end = np.vstack([c.position + arms[:3], [c.internal_point] * 6])
    by_start = [still] * 3 + [moved(arm) for arm in arms[3:]] + [still] * 3
    return start, end, np.array(by_start), np.array([moved(arm) for arm in arms[:3]] + [of_o] * 6), moved


def _legs(g, c):
    start, end, by_start, by_end, moved = _points(g, c)
    along = end - start
    length = np.linalg.norm(along, axis=1)
    e = along / length[:, None]
    return e, length, by_start, by_end, moved, np.einsum("ki,kij->kj", e, by_end - by_start)


def forces(study, g, c):
    """The greatest moduli of the leg forces over the loads of a study at one configuration, shape (9,)."""
    e, length, by_start, by_end, moved, h = _legs(g, c)
    masses, gravity = study.masses, np.array(study.loads.gravity)
    centre = np.array(study.tool.seen(masses.centre)) if study.tool else np.array(masses.centre)
    own = masses.platform * gravity @ moved(c.rotation @ centre)
    own = own + np.concatenate([np.zeros(6), masses.internal_point * gravity])
    for k in range(9):
        turns = (np.eye(3) - np.outer(e[k], e[k])) @ (by_end[k] - by_start[k]) / length[k]
        own = own + masses.cylinder * gravity @ (by_start[k] + masses.cylinder_centre * turns)
        own = own + masses.rod * gravity @ (by_end[k] - masses.rod_centre * turns)
    loads = [np.concatenate([w, np.zeros(3)]) + own for w in study.loads.wrenches or [np.zeros(6)]]
    return np.abs([np.linalg.solve(h.T, -load) for load in loads]).max(axis=0)


def rates(study, g, c, internal):
    """The greatest rates of the legs in any direction of both speeds while O moves by a rule, shape (9,)."""
    *_, moved, h = _legs(g, c)
    follows = {
        "held": np.zeros((3, 6)),
        "shifted": np.hstack([np.zeros((3, 3)), np.eye(3)]),
        "carried": moved(c.internal_point - c.position)[:, :6],
        "least": -np.linalg.lstsq(h[3:, 6:], h[3:, :6], rcond=None)[0],
    }[internal]
    by_twist = h[:, :6] + h[:, 6:] @ follows
    turn, shift = np.linalg.norm(by_twist[:, :3], axis=1), np.linalg.norm(by_twist[:, 3:], axis=1)
    return study.speeds.linear * shift + study.speeds.angular * turn
