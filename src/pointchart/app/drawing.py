"""What the page shows in space: the cloud, a neighbourhood, loops, parameters, mesh and surface."""

import asyncio
from collections.abc import Callable
from functools import partial
from threading import RLock

import numpy as np
import viser

from ..look.paint import STONE
from ..points.neighbors import nearest
from ..points.planes import normals
from ..typing import UV, Floats, Indices, Loop, Points, Triangles
from .followers import MIDDLE, Followers
from .frame import Frame, coarser, shades, spacing, stance, thinned
from .one_neighborhood import Around
from .painter import SPACING, Painter
from .picking import Camera, nearest_to_ray
from .window_fit import DISTANCE, whole_distance

MOST_POINTS, MOST_TRIANGLES = 300_000, 400_000  # drawn: a choice, for browsers that have no graphics card to draw with
MOST_EDGED = 100_000  # triangles; the edges of more make one dark plane
FEW_POINTS, FEW_TRIANGLES = 20_000, 20_000  # while the camera moves, where a browser is slow
FAR = 4000.0  # beyond what cameras draw, but not beyond what is under the pointer
NEAREST = 12  # points whose plane tells how a point is lit

# Of the loop, other loops, links from strong to weak, edges; the first and the last as in pictures.
LOOP, OTHER, LINK, PALE, EDGE = (200, 85, 61), (226, 160, 60), (24, 78, 119), (190, 214, 230), (34, 48, 60)
FINE, COARSE = "fine", "coarse"  # levels of detail
# What can be shown: in space, and in the plane of the parameters, which is looked at from above.
IN_SPACE = ("cloud", "mesh", "surface")
GROUPS = (*IN_SPACE, "plane", "flat")
UPWARDS = 0.0, 0.0, 1.0  # in the scene; the scan is turned to stand so


class Drawing:
    """The scene of the page.

    Parameters
    ----------
    server : viser.ViserServer
    points : (n, 3) array
        The scan.
    """

    def __init__(self, server: viser.ViserServer, points: Points) -> None:
        self._server, self._scene, self._scan = server, server.scene, points
        self.frame = Frame(points)
        self.places = self.frame.places(points)
        self.drawn = thinned(len(points), MOST_POINTS)
        self._few = thinned(len(self.drawn), FEW_POINTS)
        some = self.places[self.drawn].astype(np.float64)
        around = nearest(some, NEAREST)
        self.spacing = spacing(some, around)
        self._paint = Painter(self._scene, self.spacing)
        self._paint.light_up()
        self._normals = normals(some, around).astype(np.float32)
        self._colors: Floats | None = None
        self._size, self._wider = 1.0, float(np.sqrt(len(self.drawn) / len(self._few)))
        self.changing = RLock()  # held by whatever changes how the cloud is drawn
        self._groups = {name: self._scene.add_frame(f"/{name}", show_axes=False) for name in GROUPS}
        self._fine, self._coarse = (
            [self._scene.add_frame(f"/{name}/{level}", show_axes=False) for name in GROUPS] for level in (FINE, COARSE)
        )
        self.show("cloud")
        self.coarsen(False)
        server.on_client_connect(Followers(GROUPS, lambda: self._shown, self.coarsen).follow)
        self.stand(None)

    def stand(self, up: str | None) -> None:
        """Turn an axis of the file upwards, or the one that is chosen by default, and look at the scan anew."""
        from scipy.spatial.transform import Rotation

        with self.changing:
            self.axes, self.facing = stance(self._scan, up)
            turn = np.roll(Rotation.from_matrix(self.axes).as_quat(), 1)
            for name in IN_SPACE:
                self._groups[name].wxyz = turn
            self._light = shades(self._normals @ self.axes.T)
            self.color_cloud(self._colors)
            look = self._server.initial_camera
            look.position, look.look_at, look.up = tuple(DISTANCE * self.facing), MIDDLE, UPWARDS
            look.fov = np.deg2rad(45.0)
            for client in self._server.get_clients().values():
                self._look(client)

    def _look(self, client: viser.ClientHandle) -> None:
        client.camera.position = tuple(whole_distance(client.camera.aspect) * self.facing)
        client.camera.look_at, client.camera.up_direction = MIDDLE, UPWARDS

    def camera(self, client: viser.ClientHandle) -> Camera:
        """Return the camera of a browser, as it stands to the places of the scan."""
        from scipy.spatial.transform import Rotation

        seen = client.camera
        turn = Rotation.from_quat(np.roll(seen.wxyz, -1)).as_matrix()
        return Camera(seen.position @ self.axes, np.asarray(turn.T @ self.axes), float(seen.fov), float(seen.aspect))

    def pointed_at(self, event: viser.SceneClickEvent) -> int | None:
        """Return the point of the scan that a click means, None if there is none."""
        origin, direction = (np.asarray(part) @ self.axes for part in (event.ray_origin, event.ray_direction))
        return nearest_to_ray(self.places, origin, direction, reach=self.spacing)

    def on_line(self, tell: Callable[[Camera, UV], object], tell_end: Callable[[Camera, UV], object]) -> None:
        """Have every line that is drawn with the shift key told, as places of the picture, (k, 2).

        Parameters
        ----------
        tell : callable
            Called while the line grows, by what serves the browser, which must not wait.
        tell_end : callable
            Called with the whole line, in another thread.
        """
        lines: dict[int, list[tuple[float, float]]] = {}
        # Only what is under the pointer can be dragged: something that is, wherever it is, and is never drawn.
        corners = FAR * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=np.float32)
        sides = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
        around = self._scene.add_mesh_simple("/around", corners, sides, opacity=0.0, side="double", cast_shadow=False)

        # Phases come in order only to what is asynchronous and does not wait.
        async def grow(event: viser.SceneNodeDragEvent[viser.MeshHandle]) -> None:
            line = lines.setdefault(event.client_id, [])
            if event.phase == "start":
                line[:] = [event.start_screen_pos]
            line.append(event.end_screen_pos)
            camera, polygon = self.camera(event.client), np.array(line)
            if event.phase == "end":
                del lines[event.client_id]
                self.clear_polygon()
                asyncio.get_running_loop().run_in_executor(None, tell_end, camera, polygon)
            else:
                tell(camera, polygon)

        around.on_drag(modifier="shift")(grow)

    def show(self, shown: str) -> None:
        """Show one of the groups and hide the others."""
        self._shown = shown
        for name, group in self._groups.items():
            group.visible = name == shown

    def coarsen(self, is_coarse: bool) -> None:
        """Draw less of what there is, in all browsers, or all of it again."""
        with self._server.atomic():
            for frames, is_shown in ((self._fine, not is_coarse), (self._coarse, is_coarse)):
                for frame in frames:
                    frame.visible = is_shown

    def color_cloud(self, colors: Floats | None) -> None:
        """Draw the cloud in colours of all its points, (n, 3) from 0 to 1, or as of stone."""
        base = STONE if colors is None else colors[self.drawn]
        with self.changing:
            self._colors = colors
            self._cloud = self._levels("cloud", self.places[self.drawn], self._light[:, None] * base, larger=self._size)

    def size_points(self, share: float) -> None:
        """Draw the points of the cloud larger or smaller."""
        with self.changing:
            self._size = share
            for handle, wider in zip(self._cloud, (1.0, self._wider), strict=True):
                handle.point_size = share * wider * SPACING * self.spacing

    def draw_loop(self, loop: Loop, others: Indices) -> None:
        """Draw the loop as it is now, and the points of other loops that were found."""
        self._paint.clear("/cloud/loop", "/cloud/corners", "/cloud/others")
        place = self.places[loop]
        if len(loop) > 1:
            self._paint.lines("/cloud/loop", np.stack([place, np.roll(place, -1, axis=0)], axis=1), LOOP, 3.0)
        for name, rows, color in (("corners", place, LOOP), ("others", self.places[others], OTHER)):
            if len(rows):
                self._paint.points(f"/cloud/{name}", rows, np.array(color) / 255.0, larger=1.4)

    def draw_around(self, around: Around, radius: float | None) -> None:
        """Draw the neighbours of a point, its links to them, darker the more they weigh, and the ball."""
        self.clear_around()
        self._scene.add_frame("/cloud/around", show_axes=False)
        center, place = self.places[around.center], self.places[around.neighbors]
        strength = (around.weights / around.weights.max())[:, None]
        colors = strength * np.array(LINK) + (1.0 - strength) * np.array(PALE)
        links = np.stack([np.broadcast_to(center, place.shape), place], axis=1)
        self._scene.add_line_segments(
            "/cloud/around/links",
            links,
            np.repeat(colors[:, None], 2, axis=1).astype(np.uint8),
            thickness=4.0,
            thickness_units="screen",
        )
        size = float(np.linalg.norm(place - center, axis=1).min()) / (SPACING * self.spacing)
        self._paint.points("/cloud/around/neighbors", place, colors / 255.0, larger=0.5 * size)
        self._paint.points("/cloud/around/centre", center[None], np.array(LOOP) / 255.0, larger=0.6 * size)
        if around.is_star:
            sides = np.stack([place, np.roll(place, -1, axis=0)], axis=1)
            self._paint.lines("/cloud/around/star", sides[:-1] if around.is_open else sides, LINK, 1.5)
        if radius is not None:
            self._paint.ball("/cloud/around/ball", center, radius * self.frame.scale, LINK, opacity=0.15)

    def clear_around(self) -> None:
        """Draw no neighbours."""
        self._paint.clear("/cloud/around")

    def draw_polygon(self, corners: Floats) -> None:
        """Draw the polygon that selects points, given its corners in space, (k, 3)."""
        self._paint.lines("/cloud/polygon", np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), LINK, 2.0)

    def clear_polygon(self) -> None:
        """Draw no polygon."""
        self._paint.clear("/cloud/polygon")

    def draw_selected(self, rows: Indices) -> None:
        """Draw the points that are selected."""
        self._paint.clear("/cloud/selected")
        if len(rows):
            self._paint.points("/cloud/selected", self.places[rows], np.array(LINK) / 255.0, larger=1.8)

    def draw_plane(self, uv: UV, loop: Loop) -> None:
        """Draw the parameters of the points, and the boundary in the plane."""
        self._paint.clear("/plane/loop")
        flat = self.frame.plane(uv)
        self._levels("plane", flat[self.drawn], self._light[:, None] * STONE, larger=0.8)
        if len(loop) > 1:
            place = flat[loop]
            self._paint.lines("/plane/loop", np.stack([place, np.roll(place, -1, axis=0)], axis=1), LOOP, 2.0)

    def draw_mesh(self, points: Points, triangles: Triangles, uv: UV) -> None:
        """Draw a mesh in space and in the plane."""
        self._mesh("mesh", self.frame.places(points), triangles)
        self._mesh("flat", self.frame.plane(uv), triangles)

    def draw_surface(self, points: Points, triangles: Triangles) -> None:
        """Draw the mesh of a surface, without its edges."""
        self._mesh("surface", self.frame.places(points), triangles, has_edges=False)

    def _levels(self, group: str, places: Floats, colors: Floats, *, larger: float) -> list[viser.PointCloudHandle]:
        few = self._few
        return [
            self._paint.points(f"/{group}/{FINE}/points", places, colors, larger=larger),
            self._paint.points(f"/{group}/{COARSE}/points", places[few], colors[few], larger=self._wider * larger),
        ]

    def _mesh(self, group: str, places: Floats, triangles: Triangles, *, has_edges: bool = True) -> None:
        add = partial(self._scene.add_mesh_simple, side="double", cast_shadow=False, receive_shadow=False)
        fine = coarser(places, triangles, MOST_TRIANGLES)
        few = coarser(*fine, FEW_TRIANGLES)
        add(f"/{group}/{FINE}/faces", *fine, color=STONE)
        add(f"/{group}/{COARSE}/faces", *few, color=STONE)
        self._paint.clear(f"/{group}/{FINE}/edges")
        if has_edges and len(triangles) <= MOST_EDGED:
            add(f"/{group}/{FINE}/edges", *fine, color=EDGE, wireframe=True, opacity=0.35)
