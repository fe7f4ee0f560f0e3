"""The outcome of a scene."""

from dataclasses import asdict, dataclass
from time import perf_counter

from sandbox.model.errors import SandboxError
from validation.compose.property_checks import Judgement, judge
from validation.compose.recorded_run import Refused, led
from validation.compose.scenes import Scene, scene
from validation.output import finite
from validation.stability.scene import Document


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a scene."""

    seed: int
    family: str
    """The seed and the family of the scene."""
    bodies: int
    joints: int
    """The numbers of bodies and joints."""
    judgements: tuple[Judgement, ...]
    """The judgements; none for a scene that was refused."""
    passed: bool
    """Whether all of them hold."""
    refused: bool
    """Whether it was refused before its first step."""
    reason: str
    """Why it was refused, or why it stopped; empty if it did neither."""
    rate: float
    """The rate of its steps [Hz]."""
    seconds: float
    """The total time [s]."""

    @property
    def name(self) -> str:
        """Its name: the family and the seed."""
        return f"{self.family}-{self.seed}"

    @property
    def failed(self) -> tuple[Judgement, ...]:
        """The judgements that do not hold."""
        return tuple(judgement for judgement in self.judgements if not judgement.passed)

    def content(self) -> dict[str, object]:
        """Return it as the content of a JSON file."""
        judgements = [finite(asdict(judgement)) for judgement in self.judgements]
        return {**finite(asdict(self)), "judgements": judgements}


def judged(seed: int) -> Outcome:
    """Run and judge the scene of a seed."""
    return judge_scene(scene(seed))


def judge_scene(found: Scene) -> Outcome:
    """Run and judge a scene."""
    begin = perf_counter()
    rate, reason, refused = float(found.document["stepping"]["rate"]), "", False
    judgements: list[Judgement] = []
    try:
        level = found.level()
        course = led(found, level)
    except (SandboxError, Refused) as error:
        refused, reason = True, str(error)
    else:
        rate, reason = course.rate, course.failure
        judgements = judge(course)
    return Outcome(
        found.seed, found.family, len(found.document["bodies"]), len(found.document["joints"]),
        tuple(judgements), not refused and all(j.passed for j in judgements), refused, reason, rate,
        perf_counter() - begin,
    )  # fmt: skip


def playable(found: Outcome) -> Document:
    """Return the level of a scene as it was run, with what is wrong in its summary."""
    document = scene(found.seed).document
    judgements = ", ".join(f"{j.name} {j.figure:.2g} (bound {j.bound:.2g})" for j in found.failed)
    summary = f"{judgements}; {found.reason}" if found.reason else judgements
    return {**document, "summary": summary, "stepping": {"rate": found.rate}}
