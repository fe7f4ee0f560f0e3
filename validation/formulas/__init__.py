"""Closed forms: pure functions of SI quantities, from the textbook, with a module per chapter.

They are independent of the formulas in the levels, so that each validates the other, and they
import nothing of the sandbox. Angles are in radians. "The chapter" is the document that the project
follows; each formula names its section, or has a line of derivation if the chapter gives none.
Every formula holds for any finite argument unless it says otherwise.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
