"""The folder of assembly modes: every configuration with the leg lengths shown, to choose from."""

from __future__ import annotations

from typing import Any

import numpy as np

from ninedof.viewer.html import number

NOT_SEARCHED = "not searched"


class Modes:
    """Builds the folder, and lists the modes of the state of a `Viewer`."""

    def __init__(self, viewer: Any, gui: Any) -> None:
        self._viewer = viewer
        find = gui.add_button("Find all", icon="search", hint="Every configuration with the leg lengths shown")
        find.on_click(lambda _: viewer.submit("modes", self.find))
        self.choice = gui.add_dropdown("Mode", [NOT_SEARCHED], disabled=True)
        self._names: list[str] = []

        def chosen(event: Any) -> None:
            if event.client_id is not None and self.choice.value in self._names:
                k = self._names.index(self.choice.value)
                viewer.submit("pose", lambda: self.show(k))

        self.choice.on_update(chosen)

    def find(self) -> None:
        """List the modes, the one nearest to the pose shown chosen."""
        state, size = self._viewer.state, self._viewer.subject.size
        found, kappa, status = state.modes()
        names = [f"{k}: condition number {number(value)}" for k, value in enumerate(kappa.tolist(), start=1)]
        here, nearest = state.configuration, 0
        if names:
            away = np.abs(found.position - here.position).max(axis=1) / size
            away += np.abs(found.internal_point - here.internal_point).max(axis=1) / size
            nearest = int(np.argmin(away + np.abs(found.rotation - here.rotation).max(axis=(1, 2))))
        self._list(names, f"none: {status}", nearest)

    def show(self, k: int) -> None:
        """Show one of the modes found."""
        state = self._viewer.state
        if state.listed is not None and k < len(state.listed):
            state.set_configuration(state.listed[k])

    def refresh(self) -> None:
        """List no mode of another design."""
        if self._viewer.state.listed is None and self.choice.options != (NOT_SEARCHED,):
            self._list([], NOT_SEARCHED, 0)

    def _list(self, names: list[str], nothing: str, shown: int) -> None:
        self._names = names
        self.choice.options = tuple(names or [nothing])
        self.choice.disabled = not names
        if names:
            self.choice.value = names[shown]
