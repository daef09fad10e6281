"""Draw the pictures of the viewer anew: `python docs/builder/viewer_pictures.py`; needs the viewer and chromium."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import ninedof as nd

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs" / "images"
SIZE = (1238, 820)
SETTLED = 12.0  # seconds: a scene drawn without a graphics card

sys.path.insert(0, str(ROOT / "tests" / "python" / "support"))


def picture(name: str, result: nd.Result, change: Callable[[Any], object], **shown: Any) -> None:
    """Write a picture of the viewer after a change of its state."""
    import chromium

    with nd.view(result, port=0, **shown) as viewer, tempfile.TemporaryDirectory() as profile:
        viewer.submit("change", lambda: change(viewer))
        with chromium.page(viewer.url, profile, *SIZE) as page:
            page.wait_for("document.body && document.body.innerText.includes('condition number')")
            while viewer.state.body.words.startswith("Computing"):
                time.sleep(0.2)
            time.sleep(SETTLED)
            page.run("document.querySelectorAll('.mantine-Notification-closeButton').forEach((x) => x.click())")
            time.sleep(3.0)
            page.picture(IMAGES / f"{name}.png")


def outside(viewer: Any) -> None:
    """Move the machine out of its region, into its workspace."""
    viewer.find_body(np.inf)
    viewer.state.set_pose(position=np.array([-95.0, 60.0, 503.0]))


def main() -> None:
    """Draw both."""
    machine = nd.optimize(nd.Study.load(ROOT / "examples" / "18_requirement.toml"), starts=2)
    picture("viewer", machine, outside)
    designs = nd.admissible(machine, {"a2": None, "b1": None}, time_limit=20.0)
    a2, b1 = max(designs.inside.tolist(), key=lambda box: (box[0][1] - box[0][0]) * (box[1][1] - box[1][0]))
    chosen = {"a2": sum(a2) / 2.0, "b1": sum(b1) / 2.0}
    picture("viewer_designs", machine, lambda viewer: viewer.state.set_variables(chosen), designs=designs)


if __name__ == "__main__":
    main()
