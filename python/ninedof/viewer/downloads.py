"""Files that the browser saves: the scene as a picture, the design shown."""

from __future__ import annotations

import io
import tempfile
from pathlib import Path
from typing import Any

from matplotlib.image import imsave

from ninedof.runs.design_file import Design, save_design


def send_design(client: Any, design: Design) -> None:
    """Send a design file."""
    with tempfile.TemporaryDirectory() as folder:
        content = save_design(design, Path(folder) / "design.toml").read_bytes()
    client.send_file_download("design.toml", content, save_immediately=True)


def send_picture(client: Any) -> None:
    """Send the scene as the client sees it, as a PNG."""
    height, width = client.camera.image_height, client.camera.image_width
    try:
        image = client.get_render(height=height, width=width, transport_format="png")
    except RuntimeError:  # the page was closed before it was drawn
        return
    stream = io.BytesIO()
    imsave(stream, image, format="png")
    client.send_file_download("ninedof.png", stream.getvalue(), save_immediately=True)
