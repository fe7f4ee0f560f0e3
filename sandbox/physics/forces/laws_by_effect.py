"""The laws of a level one by one, each with its settings."""

from collections.abc import Iterator

from sandbox.model.base import Model
from sandbox.model.effects import Effects
from sandbox.physics.forces.declared_laws import part_of
from sandbox.physics.forces.law import Given, Law
from sandbox.physics.forces.switched_laws import SwitchedLaw


def one_by_one(effects: Effects, given: Given) -> Iterator[tuple[Model, Law]]:
    """Yield each law with its settings; if these are a list, one law for each entry."""
    for effect in effects.declarations:
        if effect.is_law and not effect.turns:
            make, said = part_of(effect, "laws"), getattr(effects, effect.name)
            for entry in said if isinstance(said, tuple) else (said,):
                named = given.switches.get(getattr(entry, "name", None) or "")
                switch = named or given.switches.get(effect.name)
                for law in make((entry,) if isinstance(said, tuple) else entry, given):
                    yield entry, SwitchedLaw(law, switch) if switch else law
