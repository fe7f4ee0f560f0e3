"""Numbers and times as a person reads them."""

from math import inf, nan, pi

import pytest

from sandbox.app.words import formatting


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"), (1.5, "1.5000"), (-9.81, "−9.8100"), (1234567.0, "1.23×10⁶"),
        (2e-15, "2.00×10⁻¹⁵"), (12345.6, "12346"), (inf, "∞"), (nan, "–"),
    ],
)  # fmt: skip
def test_a_number_has_five_digits_or_a_power_of_ten(value: float, text: str) -> None:
    assert formatting.number(value) == text


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(2000, 1, "2000"), (2000, 4, "2000"), (0.5, 1, "0.5"), (20, 2, "20"), (-5e6, 1, "−5×10⁶")],
)
def test_no_number_ends_in_a_point(value: float, digits: int, text: str) -> None:
    assert formatting.number(value, digits) == text


def test_an_error_shows_its_size_only() -> None:
    assert formatting.error(3.4e-15) == "3×10⁻¹⁵"
    assert formatting.error(-1e-6) == "−10⁻⁶"
    assert formatting.error(0.0234) == "0.02"
    assert formatting.error(0) == "0"


@pytest.mark.parametrize(
    ("value", "digits", "text", "certain"),
    [
        (8167.3, 3, "8170", "8.17×10³"),
        (-1844.0, 3, "−1840", "−1.84×10³"),
        (99999.7, 3, "100000", "1.00×10⁵"),
    ],
)  # fmt: skip
def test_a_number_of_a_few_thousands_is_rounded_unless_all_its_digits_count(
    value: float, digits: int, text: str, certain: str
) -> None:
    """An energy on the stage was read as 8.17e3 J."""
    assert formatting.number(value, digits) == text
    assert formatting.number(value, digits, all_count=True) == certain


def test_names_are_read_as_words() -> None:
    assert formatting.name_in_words("rear_axle") == "rear axle"
    assert formatting.name_in_words("ball12") == "ball 12"
    assert formatting.name_in_words("falling_0") == "falling 0"
    assert formatting.name_in_words("7") == "7"


def test_angles_are_read_in_degrees() -> None:
    assert formatting.quantity(pi / 2, "rad") == "90.000°"
    assert formatting.quantity(pi, "rad/s") == "180.00°/s"
    assert formatting.quantity(2.0, "m") == "2.0000 m"


@pytest.mark.parametrize(
    ("value", "nice"), [(1, 1), (0.99, 0.5), (4.9, 2), (7, 5), (0.03, 0.02), (1234, 1000)]
)
def test_a_nice_number_is_the_next_of_one_two_five(value: float, nice: float) -> None:
    assert formatting.nice(value) == pytest.approx(nice)


def test_what_differs_by_rounding_alone_is_not_shown_as_different() -> None:
    assert formatting.measured(1.7737500000000004, 1.77375, "m") == formatting.quantity(
        1.77375, "m"
    )
    assert formatting.measured(1.774, 1.77375, "m") == "1.7740 m"
