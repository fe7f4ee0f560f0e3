"""What a hand does to a run, at which step: enough to have the same run again, to the last bit."""

from typing import Annotated, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.physics.stepping.world import World

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Action(Model):
    """Something that a hand did between two steps."""

    step: Annotated[int, Field(ge=0)]
    """how many steps had been taken"""
    kind: Literal["grab", "drag", "release", "place"]
    """took hold of a body, pulled what it held, let go of it, or put a body elsewhere"""
    body: str = ""
    """which, where it took hold of one or put it elsewhere"""
    point: Annotated[tuple[Finite, Finite], Field(strict=False)] = (0.0, 0.0)
    """[x, y] in m: where it took hold, where it pulled to, or where it put the body"""


def perform(action: Action, world: World) -> None:
    """Do it again, or for the first time.

    Raises
    ------
    SandboxError
        If the world cannot stand it.
    """
    match action.kind:
        case "grab":
            world.grab(action.body, action.point)
        case "drag":
            world.drag(action.point)
        case "release":
            world.release()
        case "place":
            world.place({action.body: action.point})
