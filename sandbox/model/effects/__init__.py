"""The manifest of effects: an effect that a level does not declare is not simulated, and is free.

Each effect has a module; see `contract` for its declaration. `Effects` is the only list of them and
defines their order; a new effect is added as a field.
"""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.accretion import Accretion
from sandbox.model.effects.attraction import Attraction
from sandbox.model.effects.belt import Belt
from sandbox.model.effects.buoyancy import Buoyancy
from sandbox.model.effects.centrifugal import Centrifugal
from sandbox.model.effects.contact import Contact
from sandbox.model.effects.contract import Effect, register
from sandbox.model.effects.drag import Drag
from sandbox.model.effects.field import Field as ForceField
from sandbox.model.effects.force import Force
from sandbox.model.effects.friction import Friction
from sandbox.model.effects.gravitation import Gravitation
from sandbox.model.effects.gravity import Gravity
from sandbox.model.effects.magnetic import Magnetic
from sandbox.model.effects.potential import Potential
from sandbox.model.effects.restitution import Restitution
from sandbox.model.effects.rotation import Rotation
from sandbox.model.effects.sticking import Sticking
from sandbox.model.effects.thrust import Thrust
from sandbox.model.effects.torque import Torque
from sandbox.model.effects.torsion import Torsion
from sandbox.model.json_positions import Path
from sandbox.model.number_bounds import MOST_FORCES

SEVERAL = Field(min_length=1, max_length=MOST_FORCES)


class Effects(Model):
    """The effects of a level."""

    gravity: Gravity | None = None
    """Uniform gravity."""
    contact: Contact | None = None
    """Contact between bodies."""
    friction: Friction | None = None
    """Friction between bodies in contact."""
    restitution: Restitution | None = None
    """Restitution: bodies in contact bounce."""
    sticking: Sticking | None = None
    """Perfectly inelastic collisions: bodies stick together."""
    rotation: Rotation | None = None
    """Rotation of bodies."""
    attraction: Annotated[tuple[Attraction, ...], SEVERAL] | None = None
    """Attraction or repulsion by fixed centres."""
    gravitation: Gravitation | None = None
    """Mutual attraction or repulsion of bodies."""
    centrifugal: Centrifugal | None = None
    """The centrifugal force in a plane that rotates about a vertical axis."""
    drag: Drag | None = None
    """Drag in a fluid."""
    magnetic: Magnetic | None = None
    """A magnetic field that deflects charged bodies."""
    buoyancy: Buoyancy | None = None
    """Buoyancy in a liquid."""
    potential: Annotated[tuple[Potential, ...], SEVERAL] | None = None
    """Potential energies given by formulas."""
    field: Annotated[tuple[ForceField, ...], SEVERAL] | None = None
    """Force fields."""
    force: Annotated[tuple[Force, ...], SEVERAL] | None = None
    """Applied forces."""
    torsion: Annotated[tuple[Torsion, ...], SEVERAL] | None = None
    """Torsion springs."""
    torque: Annotated[tuple[Torque, ...], SEVERAL] | None = None
    """Applied torques."""
    belt: Annotated[tuple[Belt, ...], SEVERAL] | None = None
    """Moving surfaces, such as conveyor belts."""
    thrust: Annotated[tuple[Thrust, ...], SEVERAL] | None = None
    """Rockets, which burn part of their mass."""
    accretion: Annotated[tuple[Accretion, ...], SEVERAL] | None = None
    """Bodies that gather matter."""

    @property
    def in_sequence(self) -> bool:
        """Whether simultaneous impacts are solved one after the other."""
        return self.restitution is not None and self.restitution.impacts == "sequence"

    @property
    def declared(self) -> tuple[str, ...]:
        """The names of the effects that the level declares."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)

    @property
    def declarations(self) -> Iterator[Effect]:
        """The declarations of the effects in the level."""
        return (EFFECTS[name] for name in self.declared)

    @property
    def settings(self) -> Iterator[tuple[Effect, Path, Any]]:
        """The settings of each declared effect with their paths; for a list, of each entry."""
        for effect in self.declarations:
            path, declared = ("effects", effect.name), getattr(self, effect.name)
            if isinstance(declared, tuple):
                yield from ((effect, (*path, index), one) for index, one in enumerate(declared))
            else:
                yield effect, path, declared


EFFECTS: Mapping[str, Effect] = register(Effects)
"""Every effect's declaration by its name; see `sandbox.model.effects.contract`."""
