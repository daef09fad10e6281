"""A machine with its limits as a file that the checker replays: a set of designs that holds one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from ninedof import _core
from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.duty import Tolerances
from ninedof.design.study import Study
from ninedof.proof.design_range import DesignRange
from ninedof.proof.machine_record import PROVED, MachineCertificate


def machine_file(
    study: Study, variables: Mapping[str, float], characteristic_length: float, certificate: MachineCertificate
) -> bytes:
    """Return the file of a machine every limit of which is proved, with the bound of its condition number."""
    require_replayable(study, certificate.tolerances)
    for limit in certificate.limits:
        if limit.answer != PROVED:
            raise ValueError(
                f"certificate: got {limit.name} {limit.answer}, expected one in which every limit is proved"
            )
    bound = certificate.condition[1]
    alone = replace(study, characteristic_length=float(characteristic_length))
    question = DesignRange(alone, (), (), variables, bound if math.isfinite(bound) else None)
    return _core.machine_certificate(question.for_core(), slack=certificate.slack)


def require_replayable(study: Study, tolerances: Tolerances) -> None:
    """Raise ValueError unless the checker knows all machines and poses of a proof."""
    if tolerances:
        raise ValueError(
            f"tolerance: got {max(tolerances.joints, tolerances.legs):g}, expected 0: the file that is replayed is of "
            "the machine as it is drawn. `--tolerance 0`, in Python certify(tolerance=0), proves and writes that one; "
            "without a file all machines within the tolerances are proved"
        )
    if o_is_placed(study):
        raise ValueError('internal_point: got "best", expected "shifted" or "held" for a file that is replayed')
