"""Whether two builds of ninedof, of two compilers say, agree in the main results to 1e-12.

    python packaging/agree.py PYTHON PYTHON     two interpreters, in each of which a build is installed
    python packaging/agree.py                   prints the results of this one

Status 1 if a number differs by more than 1e-12 relatively.
"""

import json
import subprocess
import sys

TOLERANCE = 1e-12


def main_results(nd):
    """What the documentation states, by name; `nd` is the package."""
    hexagon = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    tilted = nd.Configuration.neutral(zp=4.0, zs=2.4).moved([0.2, -0.1, 0.1, 0.1, 0.2, 0.3, 0.1, -0.1, 0.05])
    found = {
        "published design at zs 2.3745": nd.condition_number(hexagon, nd.Configuration.neutral(zp=3.9828, zs=2.3745)),
        "published design at zs 2.4435": nd.condition_number(hexagon, nd.Configuration.neutral(zp=3.9828, zs=2.4435)),
        "a tilted pose": nd.condition_number(hexagon, tilted),
    }
    lengths = nd.leg_lengths(hexagon, tilted)
    found |= {f"leg {leg} of it": length for leg, length in enumerate(lengths, start=1)}
    found["its assembly modes"] = len(nd.forward_position(hexagon, lengths))
    ratio = {"radius_ratio": (None, 2.0)}
    for name, study in {
        "optimum, base at most twice the platform": nd.Study(constraints=ratio),
        "the same with a twist": nd.Study(variables={"theta_z": (-1.0, 1.0)}, constraints=ratio),
    }.items():
        found[name] = nd.optimize(study).condition_number
    return {name: float(value) for name, value in found.items()}


def results_of(python):
    """The results of the build that another interpreter imports."""
    done = subprocess.run([python, __file__], capture_output=True, text=True, check=True)
    return {name: float.fromhex(text) for name, text in json.loads(done.stdout).items()}


def main(arguments):
    """Print one build's results, or compare two."""
    if not arguments:
        import ninedof

        print(json.dumps({name: value.hex() for name, value in main_results(ninedof).items()}))
        return 0
    first, second = map(results_of, arguments)
    far = 0
    for name, value in first.items():
        apart = abs(value - second[name]) / max(abs(value), abs(second[name]))
        far += not apart <= TOLERANCE
        print(f"{name}: {value!r}, {'the same bits' if apart == 0 else f'apart by {apart:.1e}'}")
    print("the builds agree" if not far else f"{far} results differ by more than {TOLERANCE:g}")
    return int(far > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
