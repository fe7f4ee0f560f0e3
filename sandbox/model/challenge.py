"""Challenges: what a level asks of a person, and which parameters are free."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from sandbox.model.annotated_field_search import Prose
from sandbox.model.base import Model, Name
from sandbox.model.expressions import Expression
from sandbox.model.measuring_instants import Instant
from sandbox.model.number_bounds import Finite
from sandbox.model.reference_fields import ParameterName, QuantityName

Sentence = Annotated[Prose, Field(min_length=1, max_length=200)]


class Goal(Model):
    """Bounds that a quantity has to meet, at an instant or at every step of the run."""

    quantity: QuantityName
    """the measured quantity, such as `ball.position.x`"""
    at: Instant | None = None
    """the time [s], or an event, which then has to happen; every step of the run if left out"""
    above: Expression | None = None
    """the lower bound, in the quantity's unit"""
    below: Expression | None = None
    """the upper bound, in the quantity's unit"""
    label: Sentence
    """a short description of the goal"""


class Challenge(Model):
    """A task: to reach goals in a run by changing some of the parameters.

    Reaching all `goals` earns a star; then each goal in `stars` that is reached earns one more.
    """

    task: Sentence
    """the task, in one or two sentences"""
    free: Annotated[tuple[ParameterName, ...], Field(min_length=1, max_length=50)]
    """the parameters that the player may change; all others are locked"""
    goals: Annotated[tuple[Goal, ...], Field(min_length=1, max_length=10)]
    """the goals for the first star"""
    stars: Annotated[tuple[Goal, ...], Field(max_length=2)] = ()
    """the goals for the second and the third star"""
    hints: Annotated[tuple[Sentence, ...], Field(max_length=5)] = ()
    """hints, from a nudge to almost the answer"""
    solution: Mapping[Name, Finite]
    """values of the free parameters that earn every star; never shown"""

    @property
    def all_goals(self) -> tuple[Goal, ...]:
        """Return the goals for all stars."""
        return (*self.goals, *self.stars)
