"""The volume of a body in a page."""

import numpy as np


def body_volume(body):
    """Volume inside the faces, by the divergence theorem: positive where they face outward."""
    points = np.array(body["vertices"])
    points = points - points.mean(axis=0)
    quads = points[np.array(body["faces"])]
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return float(np.linalg.det(triangles).sum() / 6.0)
