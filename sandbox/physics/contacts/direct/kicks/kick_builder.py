"""Builds the system of equations of a kick: the rows of all contacts and joints."""

from collections.abc import Callable
from math import nan

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import Query
from sandbox.physics.contacts.direct.kicks.corner_normals import CornerPairs
from sandbox.physics.contacts.direct.kicks.false_contacts import FalseContacts
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Layouts, Surfaces
from sandbox.physics.contacts.direct.solving.overlap_correction import OverlapCorrection
from sandbox.physics.contacts.direct.solving.warm_start import WarmStart
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Batch, Booleans, Contacts
from sandbox.physics.joints.exact.constraint_interface import Coordinates, coordinate_indices
from sandbox.physics.joints.exact.joint_system import KeptLengths
from sandbox.physics.joints.exact.shake import ExactJoints


class KickBuilder:
    """Builds the system of each kick; n bodies, m equations of joints.

    `batch` reads and writes the bodies, and `query` finds the contacts of those that were moved;
    `movable`, (n,), tells which are dynamic. `warm_start` is the last kick, for the correction of
    overlaps. `contacts` are those of the present kick, and `shift`, (n, 3), are the displacements
    by the correction of overlaps in this step [m, rad]; `corrects` tells whether it may be made:
    once, however often the kick is repeated.
    """

    def __init__(
        self,
        batch: Batch,
        joints: ExactJoints,
        surfaces: Surfaces,
        movable: Booleans,
        query: Query,
        warm_start: WarmStart,
    ) -> None:
        self._batch, self._joints, self._surfaces = batch, joints, surfaces
        self._movable, self._indices = movable, coordinate_indices(len(movable))
        self._still: Array = np.zeros((len(movable), 3))
        self._still.setflags(write=False)
        self._span = 0.0, 0.0  # of the drift after the kick [s]
        self._kept_lengths = joints.kept_lengths(0.0, 0.0)
        self._layouts = Layouts(joints, surfaces, movable)
        self._false, self._corners = FalseContacts(query), CornerPairs()
        self._overlaps = OverlapCorrection(surfaces, warm_start)
        self.contacts: Contacts = NO_CONTACTS
        self.shift = self._still
        self.corrects = True

    def find_contacts(self, moved: Callable[[], Array]) -> None:
        """Take the contacts that pymunk has found, without the false ones.

        `moved` returns the sizes of the bodies' displacements in the last step, (n, 3) [m, rad]. It
        is called only if there are new contacts.
        """
        shift = self.shift
        self.contacts = self._false.without_false(
            self._batch.contacts(),
            lambda: (self._batch.state()[:, :2], moved() + np.abs(shift)),
        )
        self.shift = self._still

    def set_course(self, until: float) -> None:
        """Take up the lengths that joints keep before and after a drift that ends at a time [s]."""
        span = until - self._joints.drift, until
        if span == self._span and not np.count_nonzero(self._joints.added):
            return
        self._span, self._kept_lengths = span, self._joints.kept_lengths(*span)

    def go_on(self, t: float) -> None:
        """Begin at a time, and not at the start [s]."""
        self._kept_lengths = self._joints.kept_lengths(t, t)

    def without_correction(self, kept_lengths: KeptLengths) -> Kick:
        """Return the system at the present positions; see `DirectSolver.without_correction`."""
        self._kept_lengths = kept_lengths
        return self.at(self._joints.pose())

    def relay(self) -> None:
        """Start again with other joints, at the present positions."""
        self._layouts.forget()
        self._span = nan, nan

    def forget(self) -> None:
        """Start again: bodies were moved."""
        self._false.forget()
        self._corners.forget()
        self.shift = self._still

    def corrected(self, leaving: Array) -> Kick:
        """Return the system at the present positions, after the correction of overlaps.

        `leaving`, (3 N,), are the displacements of the next step without forces [m, rad].
        """
        pose, _ = self._joints.coordinates()
        kick = self.at(pose)
        displacement = self._overlaps.displacement(kick, leaving) if self.corrects else None
        if displacement is None:
            return kick
        self.corrects = False
        state = self._batch.state()
        self.shift = np.where(self._movable[:, None], displacement[self._indices], 0.0)
        state[:, :3] += self.shift
        self._batch.set_state(state)
        corrected_pose = Coordinates(pose.values + displacement)
        carried = kick.carried(corrected_pose)
        found = self._false.updated(carried, state, self.shift, self._surfaces.slop)
        if found is carried:
            return kick.at_pose(corrected_pose)
        self.contacts = found
        return self.at(corrected_pose)

    def at(self, pose: Coordinates) -> Kick:
        """Return the system at given positions of the bodies."""
        joints = self._joints
        self.contacts = self._corners.with_kept_normals(self.contacts, pose, joints.origin)
        layout, running = self._layouts.of(self.contacts), self._surfaces.running
        kick = Kick.at(pose, joints, self.contacts, layout, running, self._kept_lengths)
        self._corners.note(kick)
        return kick

    def with_ahead(self, kick: Kick, ahead: Contacts) -> Kick:
        """Return the system with rows for contacts that close within the drift."""
        contacts = kick.contacts.followed_by(ahead)
        layout, ends = self._layouts.new_layout(contacts), kick.layout.touching.ends
        if ends is not None:
            first_ends = ends[:, : len(kick.contacts.bodies)]  # the first points of all come first
            layout = layout.at_ends(np.pad(first_ends, ((0, 0), (0, len(ahead.bodies)))))
        running, closes = self._surfaces.running, kick.closing_count + len(ahead.bodies)
        return Kick.at(
            kick.pose, self._joints, contacts, layout, running, kick.kept_lengths, closes
        )

    def rebuilt(
        self,
        pose: Coordinates,
        contacts: Contacts,
        kept_lengths: KeptLengths,
        ends: Booleans | None = None,
    ) -> Kick:
        """Return the system of contacts at given positions, between lengths of the joints.

        `ends` tells which of the bodies of the last contacts, (2, c), touch with the end of a side.
        """
        layout, running = self._layouts.new_layout(contacts), self._surfaces.running
        if ends is not None and ends.any():
            layout = layout.at_ends(ends)
        return Kick.at(pose, self._joints, contacts, layout, running, kept_lengths)
