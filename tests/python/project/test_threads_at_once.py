"""Threads of Python that call everything at once get the bits that one thread alone gets."""

import threading

import main_results
import numpy as np

import ninedof as nd

THREADS = 4
BOX, LEGS = ([-1, -1, 3], [1, 1, 5]), {"leg_limits": (2.0, 6.5)}


def everything():
    """Every batch function and every solver of the core, as hexadecimal floats."""
    rng = np.random.default_rng(77)
    g, some = main_results.robot(rng), main_results.poses(rng, 4)
    path = some.position[0] + np.linspace(0.0, 0.2, 5)[:, None]
    study = nd.Study.paper()
    found = {
        "path": nd.best_internal_path(g, path, some.rotation[0]).configuration.internal_point,
        "map": nd.best_internal_map(g, path).configuration.internal_point,
        "margins": nd.nearest_singularity(g, some[0]).distance,
        "mean_leg": nd.characteristic_length(g, some, "mean_leg"),
        "axis": nd.axis_singular_values(
            nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0), nd.Configuration.neutral(4.0, [2.3, 2.4])
        ),
        "errors": nd.error_map(g, some),
        "stress": nd.self_stress(g, some[0]),
        "null": nd.null_motion(g, some),
        "lengths": np.stack(nd.leg_length_bounds(g, some)),
        "singular": np.stack(nd.singular_value_bounds(g, some)),
        "starts": study.problem().starts(20, 4),
        "rotations": nd.spread_rotations(20, 0.3),
        "sample": nd.workspace(g, BOX, criteria=LEGS, method="sample", points=500, shifts=2).volume,
        "grid": nd.workspace(g, BOX, criteria=LEGS, method="grid", resolution=8).volume,
    }
    one = main_results.hexadecimal(found)
    for results in (main_results.batches(2, 500), main_results.solvers(2)):
        one |= main_results.hexadecimal(results)
    return one


def test_four_threads_at_once_have_the_results_of_one():
    alone, together = everything(), [None] * THREADS
    gate = threading.Barrier(THREADS)

    def call(k):
        gate.wait()
        together[k] = everything()

    threads = [threading.Thread(target=call, args=(k,)) for k in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for found in together:
        assert found is not None  # the thread has not failed
        assert found.keys() == alone.keys()
        assert [name for name in alone if found[name] != alone[name]] == []
