"""A pair of touching bodies for which an effect has settings."""

from sandbox.model.base import Model
from sandbox.model.reference_fields import Couple


class Pair(Model):
    """Two bodies that touch."""

    bodies: Couple
    """their names, in any order"""
