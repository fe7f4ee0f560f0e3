"""pygame_gui's manager, with a theme that looks up a widget's style directly."""

import io
import os
from typing import Any, ClassVar

from pygame_gui import PackageResource, UIManager
from pygame_gui.core import UIAppearanceTheme

Ids = list[str | None] | None
"""What a widget and all that hold it are called, from the outermost inwards."""


class Manager(UIManager):
    """Keeps the widgets of a window."""

    def create_new_theme(
        self,
        theme_path: str | os.PathLike[str] | io.StringIO | PackageResource | dict[str, Any]
        | None = None,
    ) -> UIAppearanceTheme:  # fmt: skip
        """Return the look of the widgets."""
        theme = _Theme(self.resource_loader, self._locale)
        if theme_path is not None:
            theme.load_theme(theme_path)
        return theme


class _Theme(UIAppearanceTheme):
    """Knows the names under which a look is declared, by where a widget is.

    pygame_gui keeps them by a text that joins what the widget, and all that hold it, are called: it
    grows with the product of four lengths, and takes longer to write than the names to find.
    """

    _names: ClassVar[dict[tuple[tuple[str | None, ...] | None, ...], list[str]]] = {}

    def build_all_combined_ids(
        self,
        element_base_ids: Ids,
        element_ids: list[str] | None,
        class_ids: Ids,
        object_ids: Ids,
    ) -> list[str]:
        """Return the names of a widget's look, the most specific first."""
        ids = (element_base_ids, element_ids, class_ids, object_ids)
        key = tuple(None if each is None else tuple(each) for each in ids)
        if key not in self._names:
            self._names[key] = super().build_all_combined_ids(*ids)
        return self._names[key]
