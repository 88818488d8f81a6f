"""The cameras of browsers, followed: the whole scan in the picture, and less to draw where that is slow."""

import time
from collections.abc import Callable, Sequence

import numpy as np
import viser

from .frame_rate import Pace
from .window_fit import SAME, Whole

MIDDLE = 0.0, 0.0, 0.0  # what a camera looks at until somebody turns it elsewhere


class Followers:
    """What follows the cameras of all browsers of a page.

    Parameters
    ----------
    groups : sequence of str
        What may be shown.
    shown : callable
        Tells what is.
    coarsen : callable
        Called with whether less is to be drawn, in all browsers.
    """

    def __init__(self, groups: Sequence[str], shown: Callable[[], str], coarsen: Callable[[bool], object]) -> None:
        self._groups, self._shown, self._coarsen = groups, shown, coarsen
        self._slow: set[tuple[int, str]] = set()  # browsers whose cameras move and what they draw slowly

    async def follow(self, client: viser.ClientHandle) -> None:
        """Keep pace with the camera of a browser, and the whole scan in its picture until somebody comes nearer."""
        whole, paces = Whole(), {name: Pace(self._pace_teller(client.client_id, name)) for name in self._groups}

        async def moved(camera: viser.CameraHandle) -> None:
            if camera.image_width * camera.image_height == 0:
                return
            away = float(np.linalg.norm(camera.position))
            distance = whole.corrected(away, camera.aspect, time.monotonic())
            if distance is not None and np.allclose(camera.look_at, MIDDLE, atol=SAME):
                camera.position, camera.look_at = tuple(camera.position * distance / away), MIDDLE
            # With less to draw all browsers are fast: only the one for which it is drawn is told from that.
            if not self._slow or (client.client_id, self._shown()) in self._slow:
                await paces[self._shown()].moved()

        client.camera.on_update(moved)

    def _pace_teller(self, client: int, group: str) -> Callable[[bool], None]:
        def tell(is_slow: bool) -> None:
            (self._slow.add if is_slow else self._slow.discard)((client, group))
            self._coarsen(bool(self._slow))

        return tell
