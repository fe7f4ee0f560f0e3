"""A pair of touching bodies for which an effect has settings."""

from sandbox.model.base import Model
from sandbox.model.reference_fields import Couple


class Pair(Model):
    """A pair of bodies that can touch."""

    bodies: Couple
    """the names of the bodies, in any order"""
