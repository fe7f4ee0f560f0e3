"""A grip on a body, which pulls it while the run plays and moves it while the run is paused."""

from cmath import rect

from sandbox.app.runs.live_run import LiveRun
from sandbox.model.joints import Rod, Wire, bodies_of
from sandbox.model.shapes import XY
from sandbox.model.wire_points import along


class Grip:
    """Holds at most one body of a run."""

    def __init__(self, run: LiveRun) -> None:
        self._run = run
        self._held: tuple[str, XY] | None = None  # name, grip relative to its position [m]
        self._pulling = False

    def grab(self, body: str, point: XY) -> None:
        """Grab a body at a point [m]; it is not affected before `drag`."""
        x, y = self._position(body)
        self._held = body, (point[0] - x, point[1] - y)

    def drag(self, point: XY, *, playing: bool) -> None:
        """Pull the held body towards a point [m] by a force; move it there if not `playing`."""
        if self._held is None or self._run.failure is not None:
            return
        body, (dx, dy) = self._held
        if not playing:
            self._free()
            place = self._where_held(body, (point[0] - dx, point[1] - dy))
            self._run.act("place", body, place)
            return
        if not self._pulling:
            x, y = self._position(body)
            self._run.act("grab", body, (x + dx, y + dy))
            self._pulling = self._run.failure is None
        if self._pulling:
            self._run.act("drag", "", point)

    def release(self) -> None:
        """Release the body."""
        self._free()
        self._held = None

    def _free(self) -> None:
        if self._pulling:
            self._run.act("release", "", (0.0, 0.0))
            self._pulling = False

    def _where_held(self, body: str, point: XY) -> XY:
        """Return the position nearest to a point [m] that a rod or a wire on the body allows.

        Without one it is the point itself. It is also with several: they allow no other position
        than the present one, and the run reports an error.
        """
        world = self._run.world
        named, t = world.level.joints.items(), float(world.snapshot.t)
        held = [
            (name, joint)
            for name, joint in named
            if isinstance(joint, Rod | Wire)
            and body in bodies_of(joint)
            and world.scene.joints.holds(name, t)
        ]
        if len(held) != 1:
            return point
        ((name, joint),) = held
        place = complex(*point)
        on_wire = isinstance(joint, Wire)
        place = self._on_wire(name, place) if on_wire else self._on_rod(name, body, place)
        return place.real, place.imag

    def _on_wire(self, name: str, place: complex) -> complex:
        """Return the position nearest to a place [m] with the bead on a wire."""
        world = self._run.world
        bead = world.scene.joints.wires[name]
        arm = complex(bead.point) * rect(1.0, float(world.snapshot.angle[bead.body]))
        wire = world.level.joints[name]
        assert isinstance(wire, Wire)
        points = along(wire, world.values)
        return complex(points[abs(points - place - arm).argmin()] - arm)

    def _on_rod(self, name: str, body: str, place: complex) -> complex:
        """Return the position nearest to a place [m] with the rod as long as it is."""
        world = self._run.world
        row = list(world.level.bodies).index(body)
        (one, first), (other, second) = (
            (anchor.body, anchor.kinematics(world.snapshot)[0])
            for anchor in world.scene.joints.paths[name]
        )
        end, far = (first, second) if one == row else (second, first)
        arm = end - complex(*self._position(body))  # from the centre to the rod's end
        offset = place + arm - far
        if one == other or not offset:
            return place
        return complex(far + offset / abs(offset) * abs(end - far) - arm)

    def _position(self, body: str) -> XY:
        world = self._run.world
        x, y = world.snapshot.position[list(world.level.bodies).index(body)]
        return float(x), float(y)
