"""Small experiments for tests."""

import json
from collections.abc import Mapping
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from sandbox.experiments.batch_scheduling import conduct
from sandbox.experiments.executors import Executor, SerialExecutor
from sandbox.experiments.experiment_file import parsed
from sandbox.experiments.experiment_folder import Store
from sandbox.experiments.plan import Plan
from sandbox.experiments.plan_validation import make
from sandbox.model.level_catalog import find
from sandbox.model.loading import load

RANGE = "ball.position.x@landing"


def plan(level: str, vary: Mapping[str, str], *measure: str, **others: object) -> Plan:
    """Return the plan of a correct experiment."""
    given = {"level": level, "vary": dict(vary), "measure": list(measure), **others}
    experiment, faults = parsed(given)
    assert experiment is not None, faults
    found, faults = make(experiment, level, load(find(level)))
    assert not faults
    return found


def wrong(level: str, **given: object) -> list[str]:
    """Return all mistakes of an experiment, each with its place."""
    text = {"level": level, "vary": {}, "measure": ["t@end"], **json.loads(json.dumps(given))}
    experiment, faults = parsed(text)
    if experiment is not None:
        faults = make(experiment, level, load(find(level)))[1]
    return [f"{'.'.join(map(str, fault.path))}: {fault.rule}" for fault in faults]


def table(found: Plan, folder: Path, executor: Executor | None = None) -> pa.Table:
    """Run an experiment, and return its table."""
    store = Store(folder, found)
    conduct(found, store, executor or SerialExecutor(), lambda _: None)
    return pq.read_table(store.results)
