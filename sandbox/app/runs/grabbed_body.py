"""A grip on a body, which pulls it while the run plays and moves it while the run is paused."""

from sandbox.app.runs.live_run import LiveRun
from sandbox.model.joints import Joint, Rod, bodies_of
from sandbox.model.shapes import XY


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
            place = self._on_its_rod(body, (point[0] - dx, point[1] - dy))
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

    def _on_its_rod(self, body: str, point: XY) -> XY:
        """Return the position nearest to a point [m] that a rod on the body allows.

        Without a rod it is the point itself. It is also with several rods: they allow no other
        position than the present one, and the run reports an error.
        """
        world = self._run.world
        rods = [name for name, joint in world.level.joints.items() if _is_on(joint, body)]
        if len(rods) != 1:
            return point
        row = list(world.level.bodies).index(body)
        (one, first), (other, second) = (
            (anchor.body, anchor.kinematics(world.snapshot)[0])
            for anchor in world.scene.joints.paths[rods[0]]
        )
        end, far = (first, second) if one == row else (second, first)
        arm = end - complex(*self._position(body))  # from the centre to the rod's end
        offset = complex(*point) + arm - far
        if one == other or not offset:
            return point
        place = far + offset / abs(offset) * abs(end - far) - arm
        return float(place.real), float(place.imag)

    def _position(self, body: str) -> XY:
        world = self._run.world
        x, y = world.snapshot.position[list(world.level.bodies).index(body)]
        return float(x), float(y)


def _is_on(joint: Joint, body: str) -> bool:
    """Whether a joint is a rod that holds a body."""
    return isinstance(joint, Rod) and body in bodies_of(joint)
