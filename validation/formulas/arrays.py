"""The type of what formulas over time return."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
