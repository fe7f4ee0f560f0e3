"""The level format: the content of a level's JSON file.

A `Level` is frozen: it describes a scene and never changes. Everything that moves is in the world
that `sandbox.physics` builds from it.
"""

from collections.abc import Mapping
from math import ceil
from typing import Annotated, Literal, Self

from pydantic import (
    BeforeValidator,
    Field,
    PrivateAttr,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)
from pydantic_core import PydanticCustomError

from sandbox.model.annotated_field_search import Prose
from sandbox.model.base import Model, Name
from sandbox.model.body import MAX_BODIES, Body
from sandbox.model.challenge import Challenge
from sandbox.model.effects import Effects
from sandbox.model.events import MOST_EVENTS, Event, breakable, rebounding_stops
from sandbox.model.expressions import Expression, Positive, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.joints import (
    Joint,
)
from sandbox.model.json_positions import Origin, Path
from sandbox.model.measuring_instants import ApexEvent as ApexEvent
from sandbox.model.measuring_instants import ContactEvent as ContactEvent
from sandbox.model.measuring_instants import CrossingEvent as CrossingEvent
from sandbox.model.measuring_instants import Instant as Instant
from sandbox.model.measuring_instants import LandingEvent as LandingEvent
from sandbox.model.measuring_instants import SeparationEvent as SeparationEvent
from sandbox.model.named_constants import define
from sandbox.model.number_bounds import Duration, Finite
from sandbox.model.reference_fields import Mention, QuantityName
from sandbox.model.translatable_message import Message
from sandbox.model.view import View


def _version(value: object) -> object:
    if type(value) is not int:  # True equals 1
        raise PydanticCustomError("version", "{reason}", {"reason": Message("must be 1")})
    return value


MAX_CONSTANTS = 200
"""The most constants in a level."""

ROUNDING = 1e-12
"""The share by which duration × rate may differ from a whole number."""

HIGHEST_RATE = 100_000
"""The highest rate [Hz]."""

FINEST = 1e-14
"""The smallest accuracy that may be asked for; anything below is rounding."""

Scheme = Literal[
    "leapfrog", "fourth-order", "symplectic-euler", "explicit-euler", "sixth-order", "eighth-order"
]

ORDERS: Mapping[Scheme, int] = {
    "leapfrog": 2,
    "fourth-order": 4,
    "symplectic-euler": 1,
    "explicit-euler": 1,
    "sixth-order": 6,
    "eighth-order": 8,
}
"""The orders of the schemes: the power of the step with which their errors fall."""


class Parameter(Model):
    """A number that the player can change within a range."""

    value: Finite
    """the default value"""
    min: Finite
    """the lower limit"""
    max: Finite
    """the upper limit"""
    unit: str = ""
    """the displayed unit; values are not converted, so a parameter in degrees is used as
    `angle*deg`"""
    label: Prose = ""
    """a short description of the parameter"""


class Check(Model):
    """A comparison of a quantity with its closed form, to a tolerance."""

    quantity: QuantityName
    """the measured quantity, such as `ball.position.x` or `string.tension`"""
    formula: Formula
    """the closed form, a function of the parameters and the time t"""
    tolerance: Annotated[float, Field(gt=0, allow_inf_nan=False)]
    """the largest error allowed, relative to the largest expected value; absolute if that is
    zero"""
    scale: Positive | None = None
    """the value that errors are relative to if the largest expected value is smaller: for example
    g, if the expected acceleration is a small difference of large ones"""
    valid_if: Formula | None = None
    """a condition on the parameters; if it is false, the formula does not apply"""
    at: Instant | None = None
    """the time [s] or the event at which it is checked; every step if left out"""
    label: Prose = ""
    """a short description of the check"""


class Stepping(Model):
    """The time integration: explicit settings, or a required accuracy."""

    accuracy: Annotated[float, Field(gt=0, lt=1)] | None = None
    """the largest error allowed in the level's checks or, without checks, in its positions and
    velocities; the cheapest setting that reaches it is searched for and replaces all others here"""
    rate: Annotated[float, Field(ge=1, le=HIGHEST_RATE)] = 60.0
    """Hz, steps per second"""
    iterations: Annotated[int, Field(ge=1, le=1000)] = 10
    """iterations of the solver over contacts and joints in each step"""
    solver: Literal["iterative", "direct"] | None = None
    """`direct` solves contacts directly, `iterative` by sweeps unless joints are exact; what the
    effect `contact` chooses goes first. The search for an `accuracy` chooses one"""
    scheme: Scheme = "leapfrog"
    """the integration scheme; those of fourth, sixth and eighth order are for smooth forces that
    depend only on positions and time, `symplectic-euler` is stock pymunk, `explicit-euler` is
    deliberately bad"""

    def at(self, rate: float) -> "Stepping":
        """Return the stepping with a given rate [Hz], and without an accuracy.

        Raises `ValidationError` if the rate is not allowed.
        """
        return Stepping.model_validate({**self.model_dump(), "accuracy": None, "rate": rate})

    def steps(self, duration: float) -> int:
        """Return the number of steps that reach a duration [s], up to rounding."""
        return ceil(duration * self.rate * (1 - ROUNDING))

    @model_serializer(mode="wrap")
    def _said(self, serialize: SerializerFunctionWrapHandler) -> dict[str, object]:
        """Leave out the other settings if an accuracy is asked for, and the accuracy if not."""
        said: dict[str, object] = serialize(self)
        if self.accuracy is not None:
            return {"accuracy": self.accuracy}
        return {name: value for name, value in said.items() if value is not None}

    @property
    def is_stock(self) -> bool:
        """Whether the scheme is one of Euler's.

        Such a run starts without leapfrog's half kick, so its velocities are half a step late.
        """
        return self.scheme in ("symplectic-euler", "explicit-euler")

    @property
    def order(self) -> int:
        """The order of the scheme."""
        return ORDERS[self.scheme]

    @property
    def is_composed(self) -> bool:
        """Whether a step has several drifts and kicks, which needs smooth forces."""
        return self.order > ORDERS["leapfrog"]


class Level(Model):
    """A scene, its parameters, and the closed forms that its runs are compared with."""

    schema_: Annotated[str | None, Field(alias="$schema")] = None
    """where an editor finds the JSON Schema of the format"""
    format: Annotated[Literal[1], BeforeValidator(_version)]
    """the version of the level format"""
    title: Annotated[Prose, Field(min_length=1, max_length=80)]
    """the title in the list of levels"""
    summary: Prose = ""
    """one or two sentences for the player"""
    reference: Prose = ""
    """the section of the document that the level is taken from"""
    parameters: Annotated[Mapping[Name, Parameter], Field(max_length=50)] = {}
    """the numbers that the player can change; any number in the scene can be a formula in them"""
    constants: Annotated[Mapping[Name, Expression], Field(max_length=MAX_CONSTANTS)] = {}
    """named formulas in the parameters and other constants; any formula can use them"""
    effects: Effects = Effects.model_construct()
    """the effects to simulate; an effect that is not listed is not simulated"""
    bodies: Annotated[Mapping[Name, Body], Field(min_length=1, max_length=MAX_BODIES)]
    """the bodies, by name"""
    joints: Annotated[Mapping[Name, Joint], Field(max_length=2000)] = {}
    """the joints between bodies, or between bodies and fixed points"""
    events: Annotated[Mapping[Name, Event], Field(max_length=MOST_EVENTS)] = {}
    """changes during a run: joints are cut or tied, forces switched, one-way surfaces reversed"""
    stepping: Stepping = Stepping.model_construct()
    """the time integration"""
    duration: Duration = Duration(10)
    """s, the duration of a run, over which its checks apply"""
    checks: Annotated[tuple[Check, ...], Field(max_length=200)] = ()
    """the closed forms with which a run is compared"""
    challenge: Challenge | None = None
    """a task for the player: the goals, and the parameters with which to reach them"""
    ghosts: Mapping[Annotated[Name, Mention("body")], tuple[Formula, Formula]] = {}
    """[x, y] in m, the positions of bodies by their closed forms, functions of the parameters and
    t"""
    view: View = View.model_construct()
    """the visible part of the plane"""
    _origin: Origin | None = PrivateAttr(default=None)

    @model_validator(mode="after")
    def _define(self) -> Self:
        define(self, self.constants)
        return self

    def read_from(self, origin: Origin) -> None:
        """Record the text that it was read from."""
        self._origin = origin

    @property
    def text(self) -> str:
        """The text that it was read from; empty if there is none."""
        return self._origin.text if self._origin else ""

    @property
    def source(self) -> str:
        """The origin of that text, such as a file; empty if there is none."""
        return self._origin.source if self._origin else ""

    def location(self, path: Path) -> str:
        """Return the place of a part as at the beginning of messages; without a text, its path."""
        return self._origin.location(path) if self._origin else ".".join(map(str, path))

    @property
    def changes_during_run(self) -> bool:
        """Whether a run may change forces or joints: by an event, or as a joint breaks."""
        return bool(self.events) or any(True for _ in breakable(self.joints))

    @property
    def has_events(self) -> bool:
        """Whether anything may happen in a run: an event, a breaking joint, a rebounding stop."""
        return self.changes_during_run or any(True for _ in rebounding_stops(self.joints))

    @property
    def defaults(self) -> Values:
        """The parameters' default values."""
        return {name: parameter.value for name, parameter in self.parameters.items()}
