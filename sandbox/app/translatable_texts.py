"""Collects the texts that registers and models declare, for the catalogue of translations.

Declarations, in the window's package and those that it builds on, contain names and descriptions
in English. These texts are listed nowhere else; code that shows one translates it by
`language.say`.
"""

import re
from collections.abc import Iterable, Iterator
from typing import Any, get_args

from sandbox.app import keymap, window_keys
from sandbox.app.building import editable_fields
from sandbox.app.building.tools.joining import kinds
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.drawing import theme
from sandbox.app.frame_budget import Load
from sandbox.app.pages.register import PAGES
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.editing.suggested_checks.recogniser_input import Setup
from sandbox.model import ledger_accounts, level_catalog
from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS
from sandbox.model.joints import KINDS
from sandbox.model.level import Level
from sandbox.physics.accuracy.error_causes_and_costs import Stage
from sandbox.physics.measuring.challenge_goals import Standing
from sandbox.physics.measuring.free_body import FRICTION, HAND, IMPACT, NORMAL

_WORD = re.compile(r"[^\W\d_]{2}(?![^{}]*\})")
"""Two successive letters outside placeholders. A text without them, such as a key or a symbol, is
the same in every language."""


def words() -> Iterator[str]:
    """Yield all texts except keys, some more than once."""
    every = (*_window_texts(), *_physics_texts(), *_format_texts())
    return filter(has_words, every)


def shown_keys() -> Iterator[str]:
    """Yield the names of keys and gestures in the help, some more than once."""
    every = (
        *(binding.shown for binding in keymap.BINDINGS),
        *(key for page in PAGES for key, _ in page.own_keys()),
        *(gesture for gesture, _ in window_keys.MOUSE),
    )
    return filter(has_words, every)


def has_words(text: str) -> bool:
    """Whether a text contains anything to translate."""
    return bool(_WORD.search(text))


def _window_texts() -> Iterator[str]:
    """Yield the names and descriptions of pages, overlays, keys, tools, themes and chapters."""
    yield from (binding.text for binding in keymap.BINDINGS)
    for page in PAGES:
        yield page.caption
        yield page.text
        yield from (text for _, text in page.own_keys())
    yield from (text for _, text in window_keys.MOUSE)
    for tool in TOOLS:
        yield tool.caption
    yield from (overlay.caption for overlay in OVERLAYS)
    yield from map(theme.title, theme.NAMES)
    chapters = (name.partition("/")[0] for name in level_catalog.names())
    yield from (chapter.capitalize() for chapter in (*dict.fromkeys(chapters), "opened"))


def _physics_texts() -> Iterator[str]:
    """Yield the names of effects, joints, forces and accounts, and of the studies' results."""
    for name, effect in EFFECTS.items():
        yield from (name, effect.shown_force_name, effect.account_name)
        yield from effect.trial or ()
    for name, kind in KINDS.items():
        yield from (name, kind.force_name)
        yield from (kind.force.name, kind.force.account_name) if kind.force else ()
    yield from kinds().values()
    yield from (NORMAL, FRICTION, IMPACT, HAND)
    yield from ledger_accounts.OTHERS
    yield from (*get_args(Standing), *Load().shares)
    yield from get_args(Stage)
    yield from get_args(Setup)


def _format_texts() -> Iterator[str]:
    """Yield the fields of a level, their descriptions, and their options."""
    for model in _models(Level, set()):
        yield editable_fields.summary_of(model)
        for name, field in model.model_fields.items():
            yield editable_fields.label_of(field.alias or name)
            yield editable_fields.help_of(model, name)
            yield from editable_fields.choices_of(field.annotation)


def _models(kind: Any, visited: set[type[Model]]) -> Iterator[type[Model]]:  # noqa: ANN401
    """Yield the models that a type consists of, except known ones."""
    kind = editable_fields.bare_type(kind)
    parts: Iterable[Any] = get_args(kind)
    if isinstance(kind, type) and issubclass(kind, Model):
        if kind in visited:
            return
        visited.add(kind)
        yield kind
        parts = (field.annotation for field in kind.model_fields.values())
    for part in parts:
        yield from _models(part, visited)
