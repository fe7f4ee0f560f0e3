"""Writing that is killed at any moment: `python -m tests.endurance.kills`.

A process writes a file again and again, first one content, then another, and is killed after a time
that nobody chose. The file must hold one of the two, whole; and what a killed process has left must
be gone once the next has written.
"""

import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from random import Random

import typer

from tests.elsewhere import ROOT

OLD, NEW = ((letter * 500_000).encode() for letter in ("old ", "new!"))

EVERY = 100

WRITER = """
import sys
from pathlib import Path
from sandbox.model.files import write_atomically
path = Path(sys.argv[1])
contents = [(letter * 500_000).encode() for letter in ("old ", "new!")]
print("ready", flush=True)
while True:
    for content in contents:
        write_atomically(path, content)
"""


def killed(path: Path, delay: float) -> None:
    """Let a process write, and kill it so long after it has begun [s]."""
    command = [sys.executable, "-c", WRITER, str(path)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) as process:
        assert process.stdout
        process.stdout.readline()
        try:
            process.wait(delay)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)


def main(count: int = 1000, seed: int = 0) -> None:
    """Kill so many processes that write, and tell what was left."""
    random, lost, most = Random(seed), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "file"
        path.write_bytes(OLD)
        for number in range(1, count + 1):
            killed(path, random.uniform(0, 0.03))
            lost += path.read_bytes() not in (OLD, NEW)
            most = max(most, len(list(Path(folder).glob(".*.part"))))
            if number % EVERY == 0:
                typer.echo(f"{number:,} killed, {lost} files lost")
    typer.echo(f"{count:,} killed: {lost} files lost; {most} part files at once at the most")
    raise typer.Exit(lost > 0 or most > 1)


if __name__ == "__main__":
    typer.run(main)
