"""The table, third part: what reads and writes files."""

import entry_things as it
from entry_rows import row

import ninedof as nd

PLACE = ("path", "run", "directory")


def at(name, call=None, **options):
    """A row of a function with a place: the same place as another kind of object is the same place."""
    return row(name, call, loose=PLACE, **options)


at("Study.load", nd.Study.load, words={"path": ("missing/there", "x", "1.0", "y" * 20, ".", "study")})(
    lambda: {"path": it.study_file()}
)
at("Study.save", lambda **a: it.study().save(**a))(lambda: {"path": it.fresh(".toml")})
at("load", words={"path": ("record.json",)})(lambda: {"path": it.run()})
at("save")(lambda: {"run": it.design(), "path": it.fresh(".toml")})
at("save", of="save: a run")(lambda: {"run": it.result(), "path": it.fresh()})
at("load_certificate", words={"run": ("certify.json",)})(lambda: {"run": it.run()})
at("check_certificate", words={"path": ("certificate",)})(
    lambda: {"path": it.proof_file(), "time_limit": 5.0, "progress": None}
)
at("AdmissibleSet.save_certificate", lambda **a: it.admissible_set().save_certificate(**a))(
    lambda: {"path": it.fresh()}
)
at("Result.save_certificate", lambda **a: it.region_result().save_certificate(**a))(
    lambda: {"certificate": it.certificate(), "path": it.fresh()}
)
at("CertifiedWorkspace.save_certificate", lambda **a: it.certified().save_certificate(**a))(
    lambda: {"path": it.fresh()}
)
at("OptimumProof.save", lambda **a: it.proof().save(**a))(lambda: {"path": it.fresh()})
at("report", few=3)(lambda: {"run": it.result(), "path": it.fresh(".html")})
at("export", words={"platform_mass": ("options",)})(
    lambda: {
        "design": it.design(),
        "format": "mjcf",
        "path": it.fresh(".xml"),
        "unit": "mm",
        "leg_mass": 1.0,
        "platform_mass": 5.0,
        "gravity": 9.81,
    }
)
for other in ("urdf", "sdf", "csv", "step", "dxf", "c", "latex"):
    at("export", of=f"export: {other}", few=10)(
        lambda other=other: {"design": it.design(), "format": other, "path": it.fresh(f".{other}"), "unit": "mm"}
    )
at("Trajectory.load", nd.Trajectory.load)(lambda: {"path": it.path_file(), "home": it.c(), "unit": "mm"})
for kind, thing in {
    "Followed": it.followed,
    "SweepResult": it.swept,
    "WorkspaceMap": it.workspace,
    "CertifiedWorkspace": it.certified,
    "AdmissibleSet": it.admissible_set,
}.items():
    at(f"{kind}.save", lambda thing=thing, **a: thing().save(**a))(lambda: {"path": it.fresh(".npz")})
    at(f"{kind}.load", getattr(nd, kind).load)(lambda thing=thing: {"path": it.saved(thing())})


def viewed(**arguments):
    viewer = nd.view(**arguments)
    viewer.close()


at("view", viewed, few=4, words={"design": ("path",)})(
    lambda: {"design": it.design(), "host": "127.0.0.1", "port": 0, "path": None, "dark": False, "designs": None}
)
