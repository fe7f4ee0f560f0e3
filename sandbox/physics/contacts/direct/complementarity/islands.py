"""Islands: groups of rows that affect each other, and are solved together."""

from collections.abc import Sequence

import numpy as np

from sandbox.physics.engine.space_arrays import Booleans, Integers


def islands(bodies: Sequence[Integers], can_move: Booleans) -> list[Integers]:
    """Return the rows of each island, in ascending order; m rows, n bodies.

    `bodies` are those that each row is about; −1, or the number n, is the plane. `can_move`, (n,),
    tells which of them can be moved: the others pass nothing on.
    """
    owner = list(range(len(can_move)))

    def root(body: int) -> int:
        while owner[body] != body:
            owner[body] = owner[owner[body]]
            body = owner[body]
        return body

    heads, movable = [], set(can_move.nonzero()[0].tolist())
    for bodies_of_row in bodies:
        moving = [body for body in bodies_of_row.tolist() if body in movable]
        heads.append(moving[0] if moving else -1)
        for body in moving[1:]:
            owner[root(body)] = root(moving[0])
    found: dict[int, list[int]] = {}
    for number, head in enumerate(heads):
        if head >= 0:
            found.setdefault(root(head), []).append(number)
    return [np.array(rows, dtype=np.intp) for rows in found.values()]
