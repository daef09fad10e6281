"""What ties a certificate to its machine: another one, or one that was changed, is told."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256

import numpy as np

from ninedof.design.study import Study
from ninedof.proof.machine_record import MachineCertificate
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.seal import digest_of


def machine_digest(
    study: Study, geometry: Geometry, configurations: Configuration, characteristic_length: float
) -> str:
    """Return a digest of every number on which a proof of the condition number depends."""
    region = study.objective.region
    digest = sha256(repr((float(characteristic_length), region and region.for_core())).encode())
    joints = (geometry.base_external, geometry.base_internal, geometry.platform_external, geometry.platform_internal)
    for array in (*joints, configurations.position, configurations.rotation, configurations.internal_point):
        digest.update(repr(np.asarray(array, float).tolist()).encode())
    return digest.hexdigest()


def sealed(made: MachineCertificate, machine: str) -> MachineCertificate:
    """Return a certificate with its seal: a digest of the machine and of all that the certificate says."""
    return replace(made, seal=digest_of(replace(made, seal="").to_dict(), machine))


def belongs(certificate: MachineCertificate, machine: str) -> bool:
    """Whether a certificate is that of a machine, as it was written."""
    return sealed(certificate, machine).seal == certificate.seal
