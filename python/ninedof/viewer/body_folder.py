"""The folder of the workspace, which is sought in a thread of its own."""

from __future__ import annotations

import math
from typing import Any

from ninedof.support.units import amount
from ninedof.viewer.body import Body
from ninedof.viewer.body_job import BodyJob
from ninedof.viewer.html import words_html


class BodyFolder:
    """Builds the folder, and draws the workspace of the state of a `Viewer`."""

    def __init__(self, viewer: Any, gui: Any) -> None:
        self._viewer = viewer
        self._job = BodyJob(self._found, self._failed)
        limited = viewer.subject.study is not None
        hint = "Greatest condition number; 0 for none. The limits of the study hold besides"
        most = gui.add_number("cond. no. ≤", 0.0 if limited else 6.0, min=0.0, step=0.5, hint=hint)
        button = gui.add_button("Compute", icon="cube", hint="Positions in the orientation shown, a coarse picture")
        button.on_click(lambda _: self.compute(float(most.value)))
        clear = gui.add_button("Remove", icon="trash")
        clear.on_click(lambda _: self.remove())
        self.text = gui.add_html("")

    def compute(self, condition_limit: float) -> None:
        """Draw the workspace as soon as it is known; one that is still sought is given up."""
        viewer = self._viewer
        with viewer.lock:
            self._job.begin(viewer.state.body_question(condition_limit if condition_limit >= 1.0 else math.inf))
            self.tell("Computing ...")

    def remove(self) -> None:
        """Remove the workspace."""
        with self._viewer.lock:
            self._job.cancel()
            self.tell("")
        self._viewer.submit("remove body", self._viewer.scene.remove_body)

    def close(self) -> None:
        """End the search."""
        self._job.close()

    def tell(self, text: str) -> None:
        """Say how the workspace stands."""
        self.text.content = words_html(text)

    def _found(self, search: int, found: Body) -> None:
        def show() -> None:  # under the lock under which a search begins and is given up
            if self._job.counts(search):
                self.tell(self._words(found))
                self._viewer.scene.draw_body(found.vertices, found.faces)

        self._viewer.submit(f"body {search}", show)

    def _failed(self, search: int, why: str) -> None:
        def tell() -> None:
            if self._job.counts(search):
                self.tell(f"Not found: {why}")

        self._viewer.submit(f"body {search}", tell)

    def _words(self, found: Body) -> str:
        if found.volume <= 0.0:
            return "No position keeps all limits here."
        unit = self._viewer.subject.unit
        more = ", and more beyond what was looked at" if found.open else ""
        when = "with the orientation and the rule for O of the moment it was asked for"
        return f"Volume about {amount(f'{found.volume:.3g}', f'{unit}³' if unit else '')}{more}, {when}."
