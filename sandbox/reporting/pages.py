"""Self-contained HTML pages."""

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined


def environment(package: str) -> Environment:
    """Return what makes pages of a package's templates, and of those that all pages share."""
    return Environment(
        loader=ChoiceLoader([PackageLoader(package), PackageLoader("sandbox.reporting")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
