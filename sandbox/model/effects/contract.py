"""The contract of an effect: what it declares once, and everything else derives from.

To add one, see `docs/how-to/add-an-effect.md`. An effect is

- a module of its name in `sandbox/model/effects/`: a frozen model whose docstring is the equation,
  whose fields name their units, and whose `effect` is an `Effect`, as below;
- a field in the list, `Effects` in `sandbox/model/effects/__init__.py`;
- if it is a force, a module of the same name in `sandbox/physics/forces/`, with a function `laws`;
  see `sandbox.physics.forces.law` for what a law is.

From these follow the manifest and its JSON Schema, the messages about unknown effects, keys and
bodies, the remarks about effects without strength, what is offered to be tried in the app and
switched on by `--with`, the accounts of the ledger and the quantities that tell them, the schemes
that a level may have, and the tests that go through all effects. What is forgotten is told when the
package is loaded, with the file that it belongs in.

Which fields name bodies is not said here: it is their type (see `sandbox.model.reference_fields`).
Nor are units: the types in `sandbox.model.bounds` have them, and a field's docstring says them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from sandbox.model.expressions import Expression

Book = Literal["potential", "loss", "work", "none"]
"""Where the energy goes that an effect takes: it is stored, lost for good, or was put in from
outside; `none` if the effect does no work."""

Sight = Literal["position", "angle", "velocity", "time"]
"""What a force depends on."""

Settings = Mapping[str, object]
"""The fields of an effect, as they would stand in a level's file."""


class IncompleteError(TypeError):
    """An effect or a joint whose declaration is incomplete; the message says what is missing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """The declaration of an effect.

    Attributes
    ----------
    name
        In the manifest, and of its modules.
    acts
        As a `law`, a force in a module of `sandbox/physics/forces/`; by a force that `pymunk`
        applies itself; or on the `scene`, as surfaces and moments of inertia are set up.
    sees
        What the force depends on.
    smooth
        Whether it is as smooth as what it depends on. A jump makes any scheme first order there.
    book
        What becomes of the energy that it takes; `none` if it does no work. A law that does none
        although it depends on the velocity turns velocities (see `sandbox.physics.forces.law`).
    drives
        Whether one that says something is booked as `work` after all; never if left out.
    account
        The account of its energy; its name if left out.
    inside
        Whether it acts between bodies only, so that all of them together get no momentum from it.
    strength
        The fields without which it does nothing: if they are all zero, a remark says so.
    needs
        Fields of which one must be greater than zero, or the level is refused.
    coefficient
        The type of the coefficients that bodies and pairs have, in a field of its name.
    trial
        How it is tried where nothing is said of it; None if it must be told what it is.
    changes_mass
        Whether the masses of the bodies that it names change.
    twists
        Whether it turns bodies by itself, so that `rotation` is of use with it.
    pull
        The name of its force in a free-body diagram; its own name if left out.
    """

    name: str
    acts: Literal["law", "pymunk", "scene"] = "law"
    sees: tuple[Sight, ...] = ()
    smooth: bool = True
    book: Book = "none"
    drives: Callable[[Any], bool] | None = None
    account: str = ""
    inside: bool = False
    strength: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    coefficient: type[Expression] | None = None
    trial: Settings | None = None
    changes_mass: bool = False
    twists: bool = False
    pull: str = ""

    @property
    def is_force(self) -> bool:
        """Whether it is a force, and not something that the scene is made of."""
        return self.acts != "scene"

    @property
    def is_law(self) -> bool:
        """Whether it is a force that pymunk does not apply by itself."""
        return self.acts == "law"

    @property
    def sees_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return "velocity" in self.sees

    @property
    def turns(self) -> bool:
        """Whether it turns velocities, and does no work by that."""
        return self.is_law and self.book == "none"

    @property
    def booked(self) -> str:
        """What its energy is booked as."""
        return self.account or self.name

    @property
    def excludes(self) -> tuple[str, ...]:
        """The schemes that a level with it cannot have."""
        return () if self.smooth and not self.sees_velocity else ("fourth-order",)

    @property
    def called(self) -> str:
        """What its force is called in a free-body diagram."""
        return self.pull or self.name

    def stores(self, name: str) -> bool:
        """Whether it is the effect of that name, and stores energy."""
        return self.name == name and self.book == "potential"

    def book_of(self, said: object) -> Book:
        """Return where the energy goes that the effect takes, given its settings."""
        return "work" if self.drives and self.drives(said) else self.book
