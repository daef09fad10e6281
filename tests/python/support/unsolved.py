"""A design as the result of a region study holds it, without the solving."""

from types import SimpleNamespace

import ninedof as nd
from ninedof.design.domains.region_poses import posed

ANGLES = ("base_internal_angle", "platform_external_angle", "platform_internal_angle")
SIZES = {"base_external_radius": 5.0, "base_internal_radius": 3.0, "zp": 4.0, "zs": 2.2}
SIZES |= {"platform_external_radius": 2.0, "platform_internal_radius": 1.2}


def unsolved(study, angles):
    """Of a symmetric study of these entries, with the angles of the triples."""
    study = nd.Study(family="symmetric", characteristic_length=1.5, **study)
    variables, solved = SIZES | dict(zip(ANGLES, angles, strict=True)), posed(study, (nd.Pose(),))
    point = solved.evaluate(variables)
    names = ("geometry", "configuration", "configurations", "characteristic_length")
    return SimpleNamespace(
        study=study, solved=solved, variables=variables, **{name: getattr(point, name) for name in names}
    )
