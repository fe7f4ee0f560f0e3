"""A hold on a body of a run: the body is pulled while time passes, else put elsewhere."""

from sandbox.app.live_run import LiveRun
from sandbox.model.shapes import XY


class Grip:
    """Holds a body of a run, or none."""

    def __init__(self, run: LiveRun) -> None:
        self._run = run
        self._held: tuple[str, XY] | None = None  # where on it, from its position [m]
        self._pulling = False

    def grab(self, body: str, point: XY) -> None:
        """Take hold of a body at a point [m]; nothing happens to it before `drag`."""
        x, y = self._position(body)
        self._held = body, (point[0] - x, point[1] - y)

    def drag(self, point: XY, *, playing: bool) -> None:
        """Pull what is held to a point [m]: while time runs with a force, else put it there."""
        if self._held is None or self._run.failure is not None:
            return
        body, (dx, dy) = self._held
        if not playing:
            self._let_loose()
            self._run.act("place", body, (point[0] - dx, point[1] - dy))
            return
        if not self._pulling:
            x, y = self._position(body)
            self._run.act("grab", body, (x + dx, y + dy))
            self._pulling = self._run.failure is None
        if self._pulling:
            self._run.act("drag", "", point)

    def release(self) -> None:
        """Let go."""
        self._let_loose()
        self._held = None

    def _let_loose(self) -> None:
        if self._pulling:
            self._run.act("release", "", (0.0, 0.0))
            self._pulling = False

    def _position(self, body: str) -> XY:
        world = self._run.world
        x, y = world.snapshot.position[list(world.level.bodies).index(body)]
        return float(x), float(y)
