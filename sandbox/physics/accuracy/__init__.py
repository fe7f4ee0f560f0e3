"""What a run's numerical error is, and which setting reaches a given accuracy.

Nothing here knows a closed form: a run is held against itself with smaller steps.
"""

from sandbox.physics.accuracy.calibration import Setting, calibrate
from sandbox.physics.accuracy.errors import AccuracyError, Cancelled
from sandbox.physics.accuracy.estimation import Estimate, estimate
from sandbox.physics.accuracy.memory import calibrated, keep, recalled, resolved
from sandbox.physics.accuracy.offers import Offer
from sandbox.physics.accuracy.runs import Watched

__all__ = [
    "AccuracyError",
    "Cancelled",
    "Estimate",
    "Offer",
    "Setting",
    "Watched",
    "calibrate",
    "calibrated",
    "estimate",
    "keep",
    "recalled",
    "resolved",
]
