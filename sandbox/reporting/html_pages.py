"""Self-contained HTML pages: their templates, and their figures as elements."""

import re
from html import escape

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup
from matplotlib.figure import Figure

from sandbox.reporting import plot_style


def environment(package: str) -> Environment:
    """Return the environment for a package's templates and those that all pages share."""
    return Environment(
        loader=ChoiceLoader([PackageLoader(package), PackageLoader("sandbox.reporting")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def inline(figure: Figure, label: str) -> Markup:
    """Return a figure as an HTML element, with a description of what it shows.

    Several figures share a page, so unused ids are dropped, and the others are unique as long as
    the figures' titles are.
    """
    text = plot_style.written(figure, "svg").decode()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"\s*font-family: [^;\"]*;?|\sxmlns(:\w+)?=\"[^\"]*\"", "", text)
    text = text.replace("xlink:href", "href").replace("#000000", "currentColor")
    text = text.replace("fill: #ffffff", "fill: none")
    text = re.sub(r" transform=\"rotate\(-0 [^\"]*\"", "", text)
    text = re.sub(r"<[^>]*>", lambda tag: _rounded(tag[0]), text)  # never the text of a label
    used = set(re.findall(r"#([mp][0-9a-f]{10})\b", text))
    text = re.sub(r" id=\"([^\"]*)\"", lambda name: name[0] if name[1] in used else "", text)
    text = re.sub(r">\s+<", "><", re.sub(r"\s*\n", " ", text))
    text = re.sub(r"<svg[^>]*?(viewBox=\"[^\"]*\")[^>]*>", _opening(label), text, count=1)
    return Markup(text)  # matplotlib has escaped what it wrote


def _rounded(tag: str) -> str:
    """Return an element's tag with coordinates rounded to a hundredth of a point."""
    return re.sub(r"-?\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", tag)


def _opening(label: str) -> str:
    title = escape(label).replace("\\", r"\\")
    return rf'<svg \1 role="img" aria-label="{title}">'
