"""What new levels begin with: a few small ones, each of which runs and checks itself."""

from pathlib import Path

FOLDER = Path(__file__).parent


def names() -> list[str]:
    """Return the names of the templates."""
    return sorted(path.stem for path in FOLDER.glob("*.json"))


def path(name: str) -> Path:
    """Return the file of a template."""
    return FOLDER / f"{name}.json"
