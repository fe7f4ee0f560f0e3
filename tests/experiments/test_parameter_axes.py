"""The values of axes: which texts are accepted, and which are not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.experiments.parameter_axes import AxisError, Grid, Listed, Normal, Uniform, parse

NUMBERS = st.floats(-1e6, 1e6, allow_nan=False).map(lambda x: round(x, 6))


@pytest.mark.parametrize(
    ("text", "axis"),
    [
        ("0:90:91", Grid(0, 90, 91)),
        ("1:1000:4:log", Grid(1, 1000, 4, "log")),
        ("5", Listed((5.0,))),
        ("1, 2.5,-3e2", Listed((1.0, 2.5, -300.0))),
        ("0..1", Uniform(0, 1)),
        ("1..100:log", Uniform(1, 100, "log")),
        ("1.00±0.01", Normal(1, 0.01)),
        ("1.00 +- 0.01", Normal(1, 0.01)),
    ],
)
def test_each_form_says_its_values(text: str, axis: object) -> None:
    assert parse(text) == axis


@given(NUMBERS, NUMBERS, st.integers(2, 50))
def test_a_grid_begins_and_ends_where_it_says_to_the_last_bit(
    low: float, high: float, count: int
) -> None:
    if low == high:
        return
    axis = parse(f"{low}:{high}:{count}")
    assert isinstance(axis, Grid)
    values = [axis.at(i) for i in range(count)]
    assert (values[0], values[-1]) == (low, high)
    assert (np.diff(values) > 0).all() == (low < high)


def test_a_logarithmic_grid_has_equal_ratios() -> None:
    axis = parse("1:1000:4:log")
    assert isinstance(axis, Grid)
    assert [axis.at(i) for i in range(4)] == pytest.approx([1, 10, 100, 1000])


def test_a_normal_distribution_has_its_mean_and_deviation() -> None:
    shares = (np.arange(1000) + 0.5) / 1000
    values = Normal(5, 0.1).quantiles(shares)
    assert values.mean() == pytest.approx(5)
    assert values.std() == pytest.approx(0.1, rel=0.01)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "empty grid"),
        ("0:90:0", "empty grid"),
        ("0:90", "FROM:TO:COUNT"),
        ("0:90:2.5", "2.5 is not a number of values"),
        ("0:0:3", "all 0"),
        ("0:90:1", "two ends"),
        ("0:10:5:log", "above 0"),
        ("0:10:5:lin", "not a scale"),
        ("1,,2", "before a comma"),
        ("1,2,1", "twice"),
        ("1;2", "not a number"),
        ("1e999", "too large"),
        ("2..1", "below its end"),
        ("1±0", "above 0"),
        ("nan", "not a number"),
    ],
)
def test_what_says_no_values_is_refused_in_words(text: str, said: str) -> None:
    with pytest.raises(AxisError, match=said):
        parse(text)
