"""The overlays of the stage: one list, from which keys, help, buttons and drawing are derived."""

from sandbox.app.stage.overlays import (
    accelerations,
    arrows,
    center,
    components,
    contacts,
    flashes,
    forces,
    ghosts,
    loads,
    momenta,
    names,
    rotation_velocities_and_center,
    trail,
)
from sandbox.app.stage.overlays.overlay import Overlay

OVERLAYS: tuple[Overlay, ...] = (
    trail.OVERLAY,
    ghosts.OVERLAY,
    flashes.OVERLAY,
    loads.OVERLAY,
    momenta.OVERLAY,
    accelerations.OVERLAY,
    components.OVERLAY,
    arrows.OVERLAY,
    contacts.OVERLAY,
    rotation_velocities_and_center.OVERLAY,
    forces.OVERLAY,
    center.OVERLAY,
    names.OVERLAY,
)
"""All overlays, in the order in which they are drawn over each other."""


def at_first() -> dict[str, bool]:
    """Return, for each overlay, whether it is initially shown."""
    return {overlay.name: overlay.on is None for overlay in OVERLAYS}
