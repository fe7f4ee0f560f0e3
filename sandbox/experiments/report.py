from typing import NamedTuple
class P(NamedTuple):
    path: str
    told: list
def write(plan, results, output): return P(output, [])
