"""The builder with which families compose their scenes."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot
from typing import TypeVar

import numpy as np

from sandbox.physics.scene.stability_limits import MARGIN
from validation.random_compositions.independent_shape_properties import is_dynamic, thinnest
from validation.stability.scene_parts import Document, G, Place, level, rounded

T = TypeVar("T")

End = object
"""An end of a joint, as in a file."""

RATES = (60, 120, 240, 240, 480, 1000, 2000)
"""The rates to draw from [Hz]; the last is only for scenes that need it."""

FLOOR = 40.0  # m, the width of floors
"""m, wide enough that nothing reaches an end within a run."""


@dataclass(slots=True)
class Draft:
    """A scene under construction."""

    rng: np.random.Generator
    """The source of all randomness."""
    bodies: dict[str, Document] = field(default_factory=dict)
    joints: dict[str, Document] = field(default_factory=dict)
    effects: Document = field(default_factory=dict)
    is_at_rest: bool = False
    """Whether the scene is at rest, and stays so."""
    conserved_momenta: tuple[str, ...] = ()
    """The momenta that no outside force but gravity changes: of x, y, angle."""
    rotation: bool = True
    """Whether bodies turn."""
    contact: bool = True
    """Whether bodies touch."""
    gravity: tuple[float, float] = (0.0, -G)
    """m/s², (x, y)."""
    friction: tuple[float, float] | None = None
    restitution: tuple[float, float] | None = None
    """The range of the bodies' coefficients; None without the effect."""
    sticky: float | None = None
    """The ratio of static to kinetic coefficients; None if they are equal."""
    duration: float = 1.5  # s

    def number(self, low: float, high: float) -> float:
        """Return a number in a range, with as many digits as a person would write."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def scaled(self, low: float, high: float) -> float:
        """Return a number in a range, uniform in its logarithm."""
        return float(f"{np.exp(self.rng.uniform(np.log(low), np.log(high))):.3g}")

    def ratio(self) -> float:
        """Return a mass ratio from 1 to 1000."""
        return self.scaled(1, 1000)

    def mass(self) -> float:
        """Return a mass such that all ratios to others are at most 1000 [kg]."""
        return self.scaled(0.1, 100)

    def count(self, low: int, high: int) -> int:
        """Return a whole number, both ends included."""
        return int(self.rng.integers(low, high + 1))

    def chance(self, share: float = 0.5) -> bool:
        """Return true with a given probability."""
        return bool(self.rng.random() < share)

    def pick(self, options: Sequence[T]) -> T:
        """Return one of several options."""
        return options[int(self.rng.integers(len(options)))]

    def add(self, name: str, shape: Document, position: Place, **rest: object) -> str:
        """Add a body, and return its name."""
        self.bodies[name] = {"shape": shape, "position": rounded(position), **rest}
        return name

    def box(self, name: str, position: Place, size: Place, mass: float, **rest: object) -> str:
        """Add a dynamic box of given width and height."""
        shape = {"type": "box", "width": size[0], "height": size[1]}
        return self.add(name, shape, position, mass=mass, **rest)

    def disc(self, name: str, position: Place, radius: float, mass: float, **rest: object) -> str:
        """Add a dynamic disc."""
        return self.add(name, {"type": "disc", "radius": radius}, position, mass=mass, **rest)

    def block(self, name: str, position: Place, size: Place, **rest: object) -> str:
        """Add a static box."""
        shape = {"type": "box", "width": size[0], "height": size[1]}
        return self.add(name, shape, position, type="static", **rest)

    def floor(self, **rest: object) -> str:
        """Add a floor whose surface is y = 0: a block, or a line."""
        if self.chance(0.7):
            return self.block("floor", (0, -0.5), (FLOOR, 1), **rest)
        ends = [[-FLOOR / 2, 0.0], [FLOOR / 2, 0.0]]
        return self.add(
            "floor", {"type": "polyline", "points": ends}, (0, 0), type="static", **rest
        )

    def join(self, name: str, kind: str, *ends: End, **rest: object) -> str:
        """Add a joint, and return its name."""
        self.joints[name] = {"type": kind, "ends": list(ends), **rest}
        return name

    def rough(self, low: float = 0.0, high: float = 1.0) -> None:
        """Declare friction, with coefficients in a range; sometimes with higher static ones."""
        self.friction = (low, high)
        self.sticky = self.number(1.05, 1.5) if self.chance(0.3) else None

    def bouncy(self, low: float = 0.0, high: float = 1.0) -> None:
        """Declare restitution, with coefficients in a range."""
        self.restitution = (low, high)

    def surfaces(self) -> None:
        """Declare friction, restitution, both, or neither."""
        if self.chance(0.6):
            self.rough()
        if self.chance(0.4):
            self.bouncy() if self.chance(0.8) else self.bouncy(1, 1)

    def document(self, title: str) -> Document:
        """Return the level."""
        bodies = {name: self._surfaced(body) for name, body in self.bodies.items()}
        return level(
            title, "", "", effects=self._manifest(), bodies=bodies, joints=self.joints,
            stepping={"rate": self._rate()},
            duration=self.duration, view=self._view(),
        )  # fmt: skip

    def _rate(self) -> float:
        """Return a rate at which no falling body moves far in a step [Hz].

        The sandbox requires that of the initial speeds; here it is also required of the speeds at
        the end of a fall.
        """
        drawn = self.pick(RATES[:-1])
        if not self.contact or self.is_at_rest:
            return drawn
        wide = thinnest({"bodies": self.bodies})
        needed = MARGIN * self._speed() / wide
        return next((rate for rate in sorted(RATES) if rate >= max(drawn, needed)), RATES[-1])

    def _speed(self) -> float:
        """Return the greatest speed of a fall [m/s]: from a body's position to y = 0."""
        moving = [body for body in self.bodies.values() if is_dynamic(body)]
        given = max(hypot(*body.get("velocity", (0, 0))) for body in self.bodies.values())
        high = max(float(body["position"][1]) for body in moving) if any(self.gravity) else 0.0
        return hypot(given, (2 * G * max(high, 0.0)) ** 0.5)

    def _surfaced(self, body: Document) -> Document:
        """Return a body with the coefficients of the declared effects, unless it has its own."""
        given: Document = {}
        if self.contact and self.friction:
            mu = body.get("friction", self.number(*self.friction))
            given["friction"] = mu
            if self.sticky and "static_friction" not in body:
                given["static_friction"] = round(mu * self.sticky, 6)
        if self.contact and self.restitution:
            given["restitution"] = body.get("restitution", self.number(*self.restitution))
        kept = ("friction", "restitution", "static_friction")
        return {**{k: v for k, v in body.items() if k not in kept}, **given}

    def _manifest(self) -> Document:
        effects: Document = dict(self.effects)
        if any(self.gravity):
            effects["gravity"] = {"acceleration": rounded(self.gravity)}
        if self.contact:
            effects["contact"] = effects.get("contact", {})
            if self.friction:
                effects["friction"] = {}
            if self.restitution:
                effects["restitution"] = {}
        if self.rotation:
            effects["rotation"] = {}
        return effects

    def _view(self) -> Document:
        places = np.array([b["position"] for b in self.bodies.values() if is_dynamic(b)])
        middle, wide = places.mean(axis=0), np.ptp(places, axis=0).max() + 4
        return {"center": rounded(np.round(middle, 3)), "width": round(float(wide), 3)}


def body_point(body: str, x: float, y: float) -> End:
    """Return a point of a body as an end of a joint [m]."""
    return {"body": body, "at": rounded((x, y))}
