"""The whole state of a world, saved and put back in place: the run goes on with the same bits.

What moves is spread over the objects of a world: the clock, the forces of the last kicks, what the
watchdog remembers, what events have cut. A list of all of it would have to be extended with every
step plugin. So everything that can change is found by following the references from the world, and
its content is put back into the same objects.

pymunk keeps more than can be read or written: the tree of bounding boxes, whose history decides in
which order pairs are found, and the impulses from which its solver starts. Therefore only worlds
without shapes, and without pymunk's own joints other than springs, can be saved: a spring's force
follows from where its ends are.
"""

from collections import deque
from collections.abc import Iterable, Sequence
from copy import copy
from functools import partial
from operator import is_
from sys import getsizeof
from types import BuiltinFunctionType, CellType, FunctionType, MethodType, ModuleType

import numpy as np
import pymunk
from pydantic import BaseModel

from sandbox.physics.stepping.world import World

_FIXED = (
    int, float, complex, str, bytes, type(None), type, ModuleType, np.generic, np.dtype, np.ufunc,
    BaseModel,
)  # fmt: skip
_ABSENT = object()

Content = tuple[object, ...]

Part = tuple[object, Content]

PART, CONTENT = 8, 100
"""The memory of a reference, and of a content besides its items [bytes]."""


def can_be_saved(world: World) -> bool:
    """Return whether all that pymunk keeps of a world can be put back."""
    space = world.scene.space
    springs = pymunk.DampedSpring, pymunk.DampedRotarySpring
    return not space.shapes and all(
        isinstance(joint, springs) or joint.max_force == 0 for joint in space.constraints
    )


class SavedState:
    """The state of a world, and of what `others` reach, as the world `can_be_saved`.

    `before` is an earlier saved state of it, with which it shares what has not changed.
    """

    def __init__(self, world: World, *others: object, before: "SavedState | None" = None) -> None:
        self._space = world.scene.space
        self._bodies = [(body, _moving(body)) for body in self._space.bodies]
        self._gravity = self._space.gravity
        self.size = 0
        """The memory that it does not share, roughly [bytes]."""
        known = {id(part[0]): part for part in before.parts} if before else {}
        self.parts: Sequence[Part] = [
            self._part(item, content, known.get(id(item)))
            for item in _reached((world, *others))
            if (content := _content(item)) is not None
        ]
        """The objects that may change, with their contents."""

    def _part(self, item: object, content: Content, known: Part | None) -> Part:
        """Return an object with its content, the same as in the state before if it has not changed.

        That object was kept there, so no other one can have its id.
        """
        self.size += PART
        if known and _is_same(known[1], content):
            return known
        self.size += CONTENT + sum(map(getsizeof, content))
        return item, content

    def put_back(self) -> None:
        """Put the world back into this state."""
        for item, content in self.parts:
            _put_back(item, content)
        for body, values in self._bodies:
            for name, value in zip(_MOVING, values, strict=True):
                if name not in _CONSTANT or getattr(body, name) != value:
                    setattr(body, name, value)
        self._space.gravity = self._gravity


def still(world: World) -> World:
    """Return a world that shows the present state, and takes no step, while the other goes on."""
    shown = copy(world)
    shown.kicks = copy(world.kicks)
    shown.kicks.clock = copy(world.kicks.clock)
    return shown


_CONSTANT = "mass", "moment"  # of most bodies, and pymunk refuses to set those of walls
_MOVING = "mass", "moment", "angle", "position", "velocity", "angular_velocity", "force", "torque"


def _moving(body: object) -> Content:
    return tuple(getattr(body, name) for name in _MOVING)


def _reached(roots: Iterable[object]) -> Iterable[object]:
    """Return all objects that can be reached from some others, and may change."""
    seen: dict[int, object] = {}
    waiting = list(roots)
    while waiting:
        item = waiting.pop()
        if not isinstance(item, _FIXED) and id(item) not in seen:
            seen[id(item)] = item
            waiting.extend(_members(item))
    return seen.values()


def _members(item: object) -> Iterable[object]:
    """Return the objects to which an object refers."""
    match item:
        case dict():
            return (*item, *item.values())
        case list() | tuple() | set() | frozenset() | deque():
            return item
        case np.ndarray():
            return (item.base,)
        case FunctionType():
            return (*(item.__closure__ or ()), *(item.__defaults__ or ()))
        case MethodType() | BuiltinFunctionType():
            return (item.__self__,)
        case partial():
            return item.func, item.args, item.keywords
        case CellType():
            return _content(item) or ()
    values = (getattr(item, name, None) for name in _slots(item))
    return (getattr(item, "__dict__", None), *values)


def _content(item: object) -> Content | None:
    """Return what an object holds itself; None if it cannot change."""
    match item:
        case dict():
            return (*item, *item.values())
        case list() | set() | deque():
            return tuple(item)
        case np.ndarray():
            return (item.copy(),) if item.flags.owndata and item.flags.writeable else None
        case CellType():
            try:
                return (item.cell_contents,)
            except ValueError:  # it is empty
                return None
    names = _slots(item)
    return tuple(getattr(item, name, _ABSENT) for name in names) if names else None


def _is_same(one: Content, other: Content) -> bool:
    if len(one) == 1 and isinstance(one[0], np.ndarray) and isinstance(other[0], np.ndarray):
        return one[0].shape == other[0].shape and one[0].tobytes() == other[0].tobytes()
    return len(one) == len(other) and all(map(is_, one, other))


def _put_back(item: object, content: Content) -> None:
    match item:
        case dict():
            half = len(content) // 2
            item.clear()
            item.update(zip(content[:half], content[half:], strict=True))
        case list():
            item[:] = content
        case set() | deque():
            item.clear()
            (item.update if isinstance(item, set) else item.extend)(content)
        case np.ndarray():
            item[...] = content[0]
        case CellType():
            item.cell_contents = content[0]
        case _:
            for name, value in zip(_slots(item), content, strict=True):
                if value is not _ABSENT and getattr(item, name, _ABSENT) is not value:
                    object.__setattr__(item, name, value)  # also of frozen ones


_known_slots: dict[type, tuple[str, ...]] = {}


def _slots(item: object) -> tuple[str, ...]:
    """Return the names of the slots of an object."""
    kind = type(item)
    if kind not in _known_slots:
        named = [name for each in kind.__mro__ for name in _named_slots(each)]
        _known_slots[kind] = tuple(n for n in named if n not in ("__dict__", "__weakref__"))
    return _known_slots[kind]


def _named_slots(kind: type) -> Iterable[str]:
    slots = vars(kind).get("__slots__", ())
    for name in (slots,) if isinstance(slots, str) else slots:
        hidden = name.startswith("__") and not name.endswith("__")
        yield f"_{kind.__name__.lstrip('_')}{name}" if hidden else name
