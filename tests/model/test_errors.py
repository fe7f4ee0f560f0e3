"""A mistake says place, rule and value."""

import pickle

from sandbox.model.errors import LevelError, Mistake
from sandbox.model.translatable_message import Message

HERE = Mistake("ball.json", 3, 7, "bodies.ball.mass", Message("must be greater than 0"), "-1")


def test_a_mistake_reads_as_compilers_write_it() -> None:
    assert str(HERE) == "ball.json:3:7: bodies.ball.mass: must be greater than 0 (found -1)"
    assert str(Mistake("ball.json", None, None, "", Message("is empty"))) == "ball.json: is empty"


def test_an_error_lists_its_mistakes_a_line_each() -> None:
    assert str(LevelError((HERE, HERE))) == f"{HERE}\n{HERE}"


def test_an_error_keeps_its_mistakes_on_the_way_to_another_process() -> None:
    assert pickle.loads(pickle.dumps(LevelError((HERE,)))).mistakes == (HERE,)
