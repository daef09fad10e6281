"""A design to move by hand, in a browser."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ninedof.motion.trajectory import Trajectory
    from ninedof.proof.admissible.result import AdmissibleSet
    from ninedof.viewer.app import Viewer


def view(
    design: Any = None,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    path: Trajectory | str | os.PathLike[str] | None = None,
    dark: bool = False,
    designs: AdmissibleSet | None = None,
) -> Viewer:
    """Show a design in a browser, to move it by hand.

    Platform and O are moved by handles or sliders, and so are the variables of the design. Legs, condition number,
    singular values, leg lengths, determinants and the margins of the study follow. The page is at `Viewer.url` until
    `Viewer.close`; the call returns at once.

    Parameters
    ----------
    design : Design, Result or path, optional
        A Design; a Result, shown with the limits of its study; or a path as `ninedof.load` takes it: a design file, a
        run folder, "RUN#7". The published design by default.
    host : str
        Address to listen at. The default is reached from this machine alone; "0.0.0.0" from the whole network, and
        nothing asks for a password: that gives a RuntimeWarning.
    port : int
        0 takes any free port.
    path : Trajectory or path, optional
        Poses of the platform to play, as `ninedof.Trajectory.load` reads them.
    dark : bool
        Dark colours.
    designs : AdmissibleSet, optional
        A set of two to four variables of the result's study, shown as a picture: a click there shows the design of that
        place. By default the one written last into the run folder, if `design` is a path.

    Returns
    -------
    Viewer
        With `url`, `design` (what is shown, as a Design), `play(path)`, `wait()` and `close()`; also a context manager.

    Raises
    ------
    ninedof.support.extras.MissingExtra
        Without viser: pip install 'ninedof[viewer]'.
    ValueError
        If there is no such design or path, or the port is in use.

    Examples
    --------
    >>> import ninedof as nd
    >>> with nd.view(port=0) as viewer:  # doctest: +SKIP
    ...     print(viewer.url)
    ...     viewer.wait()

    """
    from ninedof.motion.trajectory import Trajectory
    from ninedof.support.arguments import flag, path_argument, text
    from ninedof.support.extras import optional

    host, dark = text("host", host), flag("dark", dark)
    if path is not None and not isinstance(path, Trajectory):
        path_argument("path", path)
    optional("viser", "viewer", "the viewer")
    from ninedof.viewer.app import Viewer
    from ninedof.viewer.designs import designs_of
    from ninedof.viewer.machine import machine_of
    from ninedof.viewer.server import loopback

    machine = machine_of(design)
    viewer = Viewer(machine, host, port, dark, designs_of(machine, design, designs))
    try:
        if not loopback(host):
            words = f"host: {host} is reached from the network, by everyone there: nothing asks for a password"
            warnings.warn(words, RuntimeWarning, stacklevel=2)
        if path is not None:
            viewer.play(path)
    except BaseException:
        viewer.close()
        raise
    return viewer
