"""Challenges: what a level asks of a person, and which parameters are free."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.expressions import Expression
from sandbox.model.measuring_instants import Instant
from sandbox.model.naming import Name
from sandbox.model.prose_fields import Prose
from sandbox.model.reference_fields import ParameterName, QuantityName

Sentence = Annotated[Prose, Field(min_length=1, max_length=200)]


class Goal(Model):
    """A quantity that has to lie within bounds: at an instant, or at every step of the run."""

    quantity: QuantityName
    """such as `ball.position.x`"""
    at: Instant | None = None
    """a time [s] or an event, which then has to happen; every step of the run if left out"""
    above: Expression | None = None
    """the least that the quantity may be, in its unit"""
    below: Expression | None = None
    """the most that the quantity may be, in its unit"""
    label: Sentence
    """what has to be reached, in a few words"""


class Challenge(Model):
    """A task: some parameters may be changed, and the run has to reach its goals.

    Reaching all goals earns a star. Each further goal in `stars` that is reached, too, earns one
    more.
    """

    task: Sentence
    """what is asked for, in one or two sentences"""
    free: Annotated[tuple[ParameterName, ...], Field(min_length=1, max_length=50)]
    """the parameters that may be changed; all others are locked"""
    goals: Annotated[tuple[Goal, ...], Field(min_length=1, max_length=10)]
    """what has to be reached for the first star"""
    stars: Annotated[tuple[Goal, ...], Field(max_length=2)] = ()
    """what earns the second star, and the third"""
    hints: Annotated[tuple[Sentence, ...], Field(max_length=5)] = ()
    """what helps, from a nudge to all but the answer"""
    solution: Mapping[Name, Annotated[float, Field(allow_inf_nan=False)]]
    """values of free parameters that earn every star; shown to nobody"""

    @property
    def all_goals(self) -> tuple[Goal, ...]:
        """Return the goals for all stars."""
        return (*self.goals, *self.stars)
