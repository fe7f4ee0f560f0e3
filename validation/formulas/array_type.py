"""The type of arrays in formulas over time."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
