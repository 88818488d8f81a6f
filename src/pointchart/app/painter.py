"""Points, lines, balls and light of the scene, all drawn in one way."""

import numpy as np
import viser

from ..typing import Floats

SPACING = 0.5  # diameter of a drawn point over the spacing of those drawn: neighbours do not touch

Color = tuple[int, int, int]


class Painter:
    """What draws in a scene.

    Parameters
    ----------
    scene : viser.SceneApi
    spacing : float
        Of the points that are drawn.
    """

    def __init__(self, scene: viser.SceneApi, spacing: float) -> None:
        self._scene, self._spacing = scene, spacing

    def light_up(self) -> None:
        """Light meshes from the front; what viser has for it is twenty times as slow without a graphics card."""
        self._scene.configure_default_lights(enabled=False, cast_shadow=False)
        self._scene.configure_environment_map(None)
        self._scene.add_light_ambient("/light/all", intensity=1.1)
        for name, place, intensity in (("front", (-3.0, -5.0, 4.0), 2.2), ("back", (3.0, 5.0, -1.0), 1.2)):
            self._scene.add_light_directional(f"/light/{name}", position=place, intensity=intensity)

    def points(self, name: str, places: Floats, colors: Floats, *, larger: float = 1.0) -> viser.PointCloudHandle:
        """Draw points in colours from 0 to 1."""
        return self._scene.add_point_cloud(
            name,
            places,
            np.asarray(255.0 * colors, dtype=np.uint8),
            point_size=SPACING * larger * self._spacing,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )

    def lines(self, name: str, ends: Floats, color: Color, pixels: float) -> None:
        """Draw lines between pairs of places, (k, 2, 3)."""
        self._scene.add_line_segments(name, ends, color, thickness=pixels, thickness_units="screen")

    def ball(self, name: str, place: Floats, radius: float, color: Color, opacity: float | None = None) -> None:
        """Draw a ball."""
        at = float(place[0]), float(place[1]), float(place[2])
        self._scene.add_icosphere(name, radius, color, position=at, opacity=opacity, cast_shadow=False)

    def clear(self, *names: str) -> None:
        """Draw some things no more."""
        for name in names:
            self._scene.remove_by_name(name)
