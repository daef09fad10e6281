"""The handles in the scene: a drag moves the model, and who drags is left alone by it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ninedof.motion.rotations import from_quaternions


class Handles:
    """Listens to the handles of a `Viewer`."""

    def __init__(self, viewer: Any, server: Any) -> None:
        self._viewer = viewer
        self.held: set[tuple[str, int]] = set()
        """Handles in the hand of a user, with the client: that browser knows best where they are."""
        for name in ("platform", "O"):
            self._listen(name)

        async def left(client: Any) -> None:  # in order with the drags, of which the last then has no end
            number = client.client_id
            viewer.submit(f"left {number}", lambda: self._release({hand for hand in self.held if hand[1] == number}))

        server.on_client_disconnect(left)

    @property
    def names(self) -> set[str]:
        """Nodes of the scene that are held."""
        return {name for name, _ in self.held}

    def _listen(self, name: str) -> None:
        viewer = self._viewer
        handle = viewer.scene.gizmo(name)

        async def dragged(event: Any) -> None:  # not in a pool of threads, so that drags keep their order
            position = np.asarray(event.target.position) / viewer.scene.scale
            turn = from_quaternions(np.asarray(event.target.wxyz, dtype=np.float64)[None])[0]
            hand, is_held = (f"/{name} gizmo", event.client_id), event.phase != "end"
            hold = self.held.add if is_held else lambda hand: self._release({hand})
            viewer.submit(f"hold {name} {event.client_id}", lambda: hold(hand))
            if name == "O":
                viewer.submit("O", lambda: viewer.state.set_internal_point(position))
            else:
                viewer.submit("pose", lambda: viewer.state.set_pose(position=position, rotation=turn))

        handle.on_update(dragged)

    def _release(self, hands: set[tuple[str, int]]) -> None:
        self.held -= hands
        for node, _ in hands:
            self._viewer.scene.forget(node)
