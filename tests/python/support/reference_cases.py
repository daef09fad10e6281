"""The reference values of tests/reference, computed in multiple precision."""

import json
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import ninedof as nd

REFERENCE = Path(__file__).parents[2] / "reference"
TRIPLES = ("r", "rh", "u", "ut")


def reference_cases():
    return json.loads((REFERENCE / "kinematics.json").read_text(encoding="utf-8"))["cases"]


def rotation(wxyz):
    return Rotation.from_quat(np.roll(wxyz, -1)).as_matrix()


def of_case(case):
    return nd.Geometry(*(case["joints"][k] for k in TRIPLES)), np.concatenate([case[k] for k in "lqr"])
