"""A result for a part is reused only for the very same part."""

from sandbox.model.last_result_cache import of_the_last
from sandbox.model.level_parts import expressions
from tests.physics.scenes import disc, level


def test_only_what_was_asked_about_last_is_remembered() -> None:
    asked: list[list[int]] = []

    @of_the_last
    def length(part: list[int]) -> int:
        asked.append(part)
        return len(part)

    one, equal = [1, 2], [1, 2]
    assert [length(one), length(one), length(equal), length(one)] == [2, 2, 2, 2]
    assert asked == [one, equal, one]
    assert asked[1] is equal


def test_a_changed_copy_of_a_level_has_expressions_of_its_own() -> None:
    scene = level({"ball": disc((1, 2))}, {})
    assert ("bodies", "ball", "position", 0) in dict(expressions(scene))

    bare = scene.model_copy(update={"bodies": {}})
    assert not any(path[0] == "bodies" for path, _ in expressions(bare))
