"""Every value known from elsewhere beside ours, as the table of docs/values.md.

    python bench/python/values.py > table.md

Prints markdown. Ends with status 1 if a value is missed by more than 1e-6 of it, besides half a unit of its last known
digit; a searched value may be beaten, a proved one may not.
"""

import math
import sys
from pathlib import Path

import ninedof as nd
from ninedof.optimize.bounds import HEXAGONAL_LIMIT, HEXAGONAL_TWIST_LIMIT, kappa_star, planar_leg_ratio_bound

ROOT = Path(__file__).parents[2]
MISS = 1e-6  # relative
SQRT3 = math.sqrt(3.0)
PLATES = "ninedof evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828"

# By heading: what it is, the study, the value as known (its digits count), and whether it is proved to be the least.
STUDIES = {
    "Hexagonal plates": (
        ("no side over 1", "values/sides_1", "5.7523", False),
        ("no side over √10", "values/sides_sqrt10", "4.1026", False),
        ("no side over 10", "values/sides_10", "3.2241", False),
        ("no side over 100", "values/sides_100", "2.67555", False),
        ("no side over 1000", "values/sides_1000", "2.56324", False),
        ("no side over 100 000", "values/sides_100000", "2.53645", False),
        ("radius ratio ≤ 2: the paper's problem", "01_paper", "3.76265907859605", True),
        ("the same, θ_z free", "06_twist", "3.749827", False),
        ("base side ≤ 5.8124", "values/published_side", "3.5503", False),
        ("base side 5.8124, zp 3.9828", "values/published_base", "3.7866", False),
        ("published plates, best zs", "values/published_plates", "3.9070664", False),
        ("a1 0, b1 5.8124, zp 3.9828, as printed", "values/as_printed", "6.1902", False),
    ),
    "Planar triples": (
        ("radius ratio ≤ 2, legs ≤ 3", "values/planar_ratio2_legs3", "2.3430924", False),
        ("radius ratio ≤ 3, legs ≤ 3", "values/planar_ratio3_legs3", f"{planar_leg_ratio_bound(3.0):.10f}", True),
        ("legs ≤ 3", "values/planar_legs3", f"{planar_leg_ratio_bound(3.0):.10f}", True),
        ("radius ratio ≤ 2, legs ≤ 2", "values/planar_ratio2_legs2", f"{planar_leg_ratio_bound(2.0):.10f}", True),
        ("radius ratio ≤ 2, legs ≤ 2.5", "values/planar_ratio2_legs2_5", f"{planar_leg_ratio_bound(2.5):.10f}", True),
        ("legs ≤ 4", "values/planar_legs4", f"{planar_leg_ratio_bound(4.0):.10f}", True),
        ("practical rules", "values/planar_practical", f"{planar_leg_ratio_bound(2.5):.10f}", True),
    ),
    "Triples with heights": (
        ("practical rules, sizes ≤ 5", "09_near_isotropic", "1.4020429319", False),
        ("the same, any joint height", "values/nonplanar_any_height", "1.0762812643", False),
        ("sizes ≤ 20", "values/nonplanar_20", "1.0046", False),
        ("O at ρ = 1", "values/distance_1", f"{kappa_star(1.0):.10f}", False),
        ("O at ρ = 0.25", "values/distance_0_25", f"{kappa_star(0.25):.10f}", False),
    ),
}


def rounded(x):
    return f"{x:.6g}" if abs(x) > 1e-9 else "0"


def polar(triple, height):
    """One joint of a triple: radius, angle in degrees, height."""
    x, y, z = triple[0]
    text = f"{rounded(math.hypot(x, y))} at {math.degrees(math.atan2(y, x)):.2f}°"
    return f"{text}, z {rounded(z)}" if height else text


def design_words(result):
    v, g = result.variables, result.geometry
    if "a1" in v:
        return ", ".join(f"{name} {rounded(v[name])}" for name in v if name != "theta_z" or v[name] != 0.0)
    high = "base_external_height" in v
    triples = (("r", g.base_external), ("r̂", g.base_internal), ("u", g.platform_external), ("ũ", g.platform_internal))
    parts = [f"{name} {polar(joints, high)}" for name, joints in triples]
    return "; ".join([*parts, f"zp {rounded(v['zp'])}, zs {rounded(v['zs'])}"])


def digit(known):
    """Half a unit of the last digit of a number as it is written."""
    return 0.5 * 10.0 ** -len(known.partition(".")[2])


def studies(entries):
    """Rows of optima: what, known, ours, design, command, whether it is missed."""
    for what, path, known, proved in entries:
        result = nd.optimize(nd.Study.load(ROOT / "examples" / f"{path}.toml"))
        value, slack = float(known), digit(known)
        ours = math.inf if result.condition_number is None else result.condition_number
        missed = result.status != "optimal" or ours > value * (1.0 + MISS) + slack
        missed |= proved and ours < value * (1.0 - 1e-8) - slack
        words = design_words(result) if result.best else str(result.status)
        yield (
            what,
            f"{known}{' (proved)' if proved else ''}",
            ours,
            words,
            f"[{path.removeprefix('values/')}](../examples/{path}.toml)",
            missed,
        )


def unbounded():
    result = nd.optimize(nd.Study.load(ROOT / "examples" / "03_eqs_8_9_alone.toml"))
    missed = result.status != "unbounded" or not result.condition_number > HEXAGONAL_LIMIT
    words = f"grow: {', '.join(result.causes)}"
    yield (
        "eqs. (8)-(9) alone",
        "unbounded",
        str(result.status),
        words,
        "[03_eqs_8_9_alone](../examples/03_eqs_8_9_alone.toml)",
        missed,
    )


def triangles(radius, side, zs, rho, twist=0.0):
    """Coupled triangles, base circumradius, platform circumradius, O at zs and the platform rho above it."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=SQRT3 * radius, b1=SQRT3 * side, b2=0.0)
    return g, nd.Configuration.neutral(zp=zs + rho, zs=zs, theta_z=twist)


def designs():
    """Rows of single designs: what, known, ours, design, command, whether it is missed."""

    def row(what, known, design, words, command):
        ours = float(nd.condition_number(*design))
        value = float(known)
        return what, known, ours, words, command, abs(ours - value) > value * MISS + digit(known)

    plates = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    for zs in (2.3745, 2.5110):
        c = nd.Configuration.neutral(zp=3.9828, zs=zs)
        yield row(
            f"published plates, zs {zs:.4f}", "3.9110", (plates, c), "as the command", f"`{PLATES} --zs {zs:.4f}`"
        )
    c = nd.Configuration.neutral(zp=3.9828, zs=2.4432, theta_z=0.05)
    command = f"`{PLATES} --zs 2.4432 --theta-z-deg 2.8647889757`"
    yield row("the same, zs 2.4432, θ_z 0.05", "3.8819", (plates, c), "as the command", command)

    base, platform = (1.0116, 0.0, 0.0), (4.9410, 0.0, 0.0)
    g = nd.Geometry.symmetric(base, base, (4.9410, math.radians(36.2), 0.0), platform)
    design = g, nd.Configuration.neutral(zp=0.05, zs=22.874)
    words = "r, r̂ 1.0116, u, ũ 4.941, u 36.2° from r; zp 0.05, zs 22.874"
    yield row("O above the platform: eq. (9b) broken", "1.0221", design, words, "Python, below")

    inner, outer = math.sqrt(1.0 / 13.0), 5.0 * math.sqrt(1.0 / 13.0)
    g = nd.Geometry.symmetric(
        (math.hypot(0.7, 3.0), math.atan2(-3.0, 0.7), 6.2),
        (inner, 0.0, 0.0),
        (math.hypot(0.7, 1.0), math.atan2(1.0, 0.7), 0.2),
        (outer, 0.0, 0.0),
    )
    design = g, nd.Configuration.neutral(zp=6.0, zs=1.0)
    words = "r (0.7, -3, 6.2), r̂ radius 1/√13, u (0.7, 1, 0.2), ũ radius 5/√13; zp 6, zs 1"
    yield row("√(1 + 3/ρ²), ρ = 5", "1.0583005244", design, words, "Python, below")

    for power, known in ((6, "2.5358822254"), (8, "2.5358424249"), (9, "2.5358420631")):
        radius = 10.0**power
        design = triangles(radius, 0.667692154487, 0.410376066027 * radius, 10.675249973)
        words = f"a2 √3·10^{power}, b1 1.1564767; zs 0.410376066·10^{power}, zp zs + 10.67525"
        yield row(f"hexagons towards the limit {HEXAGONAL_LIMIT:.10f}", known, design, words, "Python, below")
    design = triangles(1e12, 0.566613247731, 0.401457171027e12, 1e5, math.radians(30.0))
    words = "a2 √3·10^12, b1 0.9814029, θ_z 30°; zs 0.401457171·10^12, zp zs + 10^5"
    what = "hexagons, θ_z free, at the limit"
    yield row(what, f"{HEXAGONAL_TWIST_LIMIT:.6f}", design, words, "Python, below")


def main():
    missed = []
    tables = {title: studies(entries) for title, entries in STUDIES.items()}
    for title, rows in (tables | {"No least value": unbounded(), "Single designs": designs()}).items():
        print(f"## {title}\n\n| | known | ours | design | study or command |\n| --- | --- | --- | --- | --- |")
        for what, known, ours, words, command, is_missed in rows:
            shown = ours if isinstance(ours, str) else f"{ours:.10f}"
            print(f"| {what} | {known} | {shown} | {words} | {command} |")
            if is_missed:
                missed.append(what)
        print()
    for what in missed:
        print(f"missed: {what}", file=sys.stderr)
    return int(bool(missed))


if __name__ == "__main__":
    sys.exit(main())
