"""A fixed machine in millimetres with a tool, and a folder of its study and run."""

import ninedof as nd


def tooled(**more):
    """A study of the machine, with constraints and what it is for."""
    return nd.Study(
        unit="mm",
        family="hexagonal",
        variables={"a1": 0.0, "a2": 580.0, "b1": 290.0, "b2": 0.0, "zp": 400.0, "zs": 240.0, "theta_z": 0.0},
        characteristic_length=100.0,
        objective={"region": {"box": [1.0, 1.0, 1.0]}},
        tool={"position": [0.0, 0.0, -10.0]},
        **more,
    )


def solved_in(place, study):
    """The folder with `study.toml` and `run`."""
    study.save(place / "study.toml")
    nd.save(nd.optimize(study), place / "run")
    return place
