"""The commands: for each a line that does little, and what is put in the place of every value."""

import re

import entry_things as it

# A line with every option that takes a value; those that exclude each other are in several lines.
LINES = {
    "optimize": ["{study} --starts 1 --seed 0 --threads 1 --time 60 --out {out} --no-report"],
    "pareto": [
        "{study} --against radius_ratio --value 1.9 --starts 1 --threads 1 --out {out} --no-report",
        "{study} --against radius_ratio --points 2 --starts 1 --out {out} --no-report",
        "{study} --against tolerance --value 0 --value 0.001 --starts 1 --out {out} --no-report",
    ],
    "evaluate": [
        "{design} --lc 1.0",
        "--a1 0 --a2 5 --b1 3 --b2 0 --zp 4 --zs 2 --theta-z-deg 0",
        "{run} --set a2=5 --plot x.png",
    ],
    "admissible": [
        "{study} --vary a2=4:8 --vary b1=1:5 --set zp=4 --set zs=2 --set theta_z_deg=0 --condition 9 "
        "--time 1 --resolution 0.2 --threads 1 --around --proportions a2=2,b1=1 --certificate {page} "
        "--out {out}"
    ],
    "compare": ["{run} {run} --plot x.png"],
    "report": ["{run} --out {page}"],
    "sheet": [
        "{design} --speed 1 --turn-deg 1 --internal least --load 0,0,0,0,0,1 --mass 1 --centre 0,0,0 --gravity 0,0,-9 "
        "--leg-error 0.1 --joint-error 0.1 --leg-stiffness 1 --csv {page}",
        "{design} --twist 0,0,0,1,0,0 --twist-rate 0,0,0,1,0,0",
    ],
    "view": ["{design} --host 127.0.0.1 --port x --path {path}"],  # a port that is none: it waits for ever
    "accuracy": [
        "{design} --leg-error 0.1 --joint-error 0.1 --samples 10 --position 0,0,4 --rotation-deg 0,0,0 "
        "--internal-point 0,0,2 --distribution normal",
        "{design} --within 0.1 --within-deg 0.1 --weights 1,1",
    ],
    "best": [
        "{design} --criterion condition_number --legs 0.5,9 --position 0,0,4 --rotation-deg 0,0,0 "
        "--internal-point 0,0,2 --lc 1"
    ],
    "certify": [
        "{run} --condition 50 --gap 0.9 --time 1 --tolerance 0.01 --slack 1e-3 --threads 1",
        "{run} --gap 0.9 --tolerance 0 --certificate {page}",
    ],
    "check": ["{certificate} --time 5"],
    "export": ["{design} --to mjcf --out {xml} --leg-mass 1 --platform-mass 1 --gravity 1 --unit mm"],
    "failure": ["{design} --condition 10 --load 0,0,0,0,0,1 --no-pairs"],
    "forces": [
        "{design} --load 0,0,0,0,0,1 --position 0,0,4 --rotation-deg 0,0,0 --internal-point 0,0,2",
        "{design} --mass 5 --centre 0,0,0.1 --gravity 0,0,-9.81",
    ],
    "payload": ["{design} --force 5 --pull 5 --centre 0,0,0.1 --load 0,0,0,0,0,1"],
    "modes": [
        "{design} --lengths 5,5,5,3,3,3,4,4,4 --certify",
        "{design} --position 0,0,4 --rotation-deg 0,0,0 --internal-point 0,0,2",
    ],
    "singularity": [
        "{design} --direction 0,0,0,0,0,0,0,0,1 --most 1 --position 0,0,4 --rotation-deg 0,0,0 --internal-point 0,0,2"
    ],
    "stiffness": ["{design} --leg-stiffness 1 --position 0,0,4 --rotation-deg 0,0,0 --internal-point 0,0,2"],
    "sweep": [
        "{design} --over x_p=-1:1:3 --index condition_number --internal-point held --lc 1 --chunk 10 --threads 1 "
        "--out {out} --no-report",
        "--over zs=1:2:3 --a1 0 --a2 5 --b1 3 --b2 0 --zp 4 --zs 2 --theta-z-deg 0 --out {out} --no-report",
        "fig6 --points 3 --out {out} --no-report",
    ],
    "atlas": ["--designs 10 --seed 0 --out {out} --no-report"],
    "workspace": [
        "{design} --archetype constant_orientation --actuators needed --x -1:1 --y -1:1 --z 3:5 "
        "--legs 0.5,9 --external 0.5,9 "
        "--upper 0.5,9 --lower 0.5,9 --condition 50 --base-cone-deg 80 --platform-cone-deg 80 --base-cone-axis 0,0,1 "
        "--platform-cone-axis 0,0,1 --clearance 0.01 --internal-point 0.5 --lc 1 --method octree --tolerance 0.9 "
        "--resolution 4 --seed 0 --index manipulability --threads 1 --out {out} --no-report",
        "{design} --archetype reachable --x -1:1 --y -1:1 --z 3:5 --tilt-deg 5 --torsion-deg 5 --orientations 3 "
        "--angle-deg 5 --legs 0.5,9 --points 10 --method sample --gap 0.9 --time 1 --out {out} --no-report",
        "{design} --archetype orientation --position 0,0,4 --angle-deg 5 --legs 0.5,9 --out {out} --no-report",
    ],
    "paper": ["--threads 1 --no-report --out {out}"],
    "path": [
        "{design} {path} --internal-point carried --legs 0.5,9 --force 0,0,1 --moment 0,0,1 --mass 1 --centre 0,0,0 "
        "--gravity 0,0,-9 --lc 1 --out {out} --no-report",
        "{design} --circle 0.1 --duration 1 --points 9 --out {out} --no-report",
        "{design} --line 0.1,0,0 --duration 1 --points 9 --out {out} --no-report",
        "{design} --spiral 0.1,0.1 --duration 1 --points 9 --out {out} --no-report",
    ],
}
DEAR = {
    "admissible",
    "optimize",
    "pareto",
    "sweep",
    "workspace",
    "certify",
    "paper",
    "report",
    "path",
    "check",
    "atlas",
    "view",
}
NOT_TRIED = {"--scheduler"}  # waits for an address: tests of the cluster have it

BAD = {
    "empty": "",
    "a word": "x",
    "NaN": "nan",
    "inf": "inf",
    "-inf": "-inf",
    "negative": "-1",
    "zero": "0",
    "huge": "1e300",
    "too huge": "1e999",
    "a long number": "9" * 400,
    "a denormal": "5e-324",
    "two numbers": "1,2",
    "many numbers": ",".join(["1"] * 1000),
    "numbers and holes": "1,,2",
    "a range": "1:0:-3",
    "an equation": "x==1:2",
    "markup": "[/bold][red]b[/]",
    "control characters": "a\x1b]0;b\x07\r\nninedof: all is well",
    "another direction": "\u202eabc",
    "long": "y" * 5000,
    "a folder": ".",
    "nothing": "missing/there.toml",
    "binary": "binary.toml",
    "a point": "run#0",
    "an option": "--",
}


def filled(line, several=(), bad=(None, "")):
    """The words of a line, its places filled; `bad` is the place of a bad value and the value.

    Options that take `several` values have them in one word, divided by commas or colons; a bad one is the first.
    """
    places = {
        "study": it.study_file,
        "design": it.design_file,
        "run": it.run,
        "path": it.path_file,
        "certificate": it.proof_file,
        "out": it.fresh,
        "page": lambda: it.fresh(".html"),
        "xml": lambda: it.fresh(".xml"),
    }
    words, made = line.split(), []
    for k, word in enumerate(words):
        values = re.split("[,:]", word) if k and words[k - 1] in several else [word]
        values = [str(places[one[1:-1]]()) if one.startswith("{") else one for one in values]
        made += [bad[1], *values[1:]] if k == bad[0] else values
    return made
