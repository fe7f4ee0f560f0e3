"""The page with the results of a tour."""

from collections.abc import Iterable
from html import escape

from sandbox.cli import check_verdicts
from sandbox.cli.tour_visit import Visit

_STYLE = """
body { font: 16px/1.45 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1f24; background: #fff }
article { margin: 3rem 0 } h2 { margin-bottom: 0 } .name, .about { color: #57606a; margin: 0 }
img { width: 100%; height: auto; border: 1px solid #d0d7de; margin-top: .6rem }
pre { overflow-x: auto; font-size: 13px; padding: .6rem; background: #f6f8fa }
.failed { color: #b42318 } .passed { color: #1a7f37 }
"""


def page(visits: Iterable[Visit]) -> str:
    """Return the page, which needs no files but the pictures beside it."""
    articles = "\n".join(_article(visit) for visit in visits)
    return (
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>Tour of the levels</title>\n<style>{_STYLE}</style>\n"
        f"<h1>Tour of the levels</h1>\n{articles}\n</html>\n"
    )


def _article(visit: Visit) -> str:
    title, summary = (visit.level.title, visit.level.summary) if visit.level else (visit.name, "")
    verdict = "passed" if visit.passed else "failed"
    parts = [
        f"<h2>{escape(title)}</h2>",
        f'<p class="name"><code>{escape(visit.name)}</code> <b class="{verdict}">{verdict}</b></p>',
        f'<p class="about">{escape(summary)}</p>',
    ]
    if visit.picture:
        parts.append(f'<img src="{escape(visit.picture)}" alt="{escape(title)}" loading="lazy">')
    found = list(check_verdicts.lines(visit.results, complete=True))
    if visit.closing:
        found.append(f"energy: {visit.closing.text}")
    said = visit.error or "\n".join(found)
    parts.append(f"<pre>{escape(said)}</pre>")
    return f'<article id="{escape(visit.name)}">\n' + "\n".join(parts) + "\n</article>"
