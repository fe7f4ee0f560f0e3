"""What the site has beyond the documents: a gallery of all levels, and pages of the root folder.

MkDocs calls the functions named `on_...`; see `mkdocs.yml`. Nothing of it is kept in the project.
"""

import os
import re
from itertools import chain, groupby
from pathlib import Path
from posixpath import dirname, normpath, relpath
from typing import TYPE_CHECKING

from sandbox.model import level_catalog
from sandbox.model.loading import load, parse

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "out" / "gallery"
FROM_ROOT = ("CONTRIBUTING.md", "CHANGELOG.md")
"""Documents beside the folder `docs`, which are pages of the site."""

GUIDE = ("tutorial/first-level.md", "how-to/recipes.md")
"""Pages on which each level is followed by its picture."""

LEVEL = re.compile(r"^```json\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s:#]+)(#[^)\s]*)?\)")


def gallery() -> str:
    """Return the page with every level's picture, chapter by chapter."""
    lines = [
        "# Gallery",
        "",
        "Every level, drawn by the sandbox itself. Play one with `python -m sandbox play NAME`.",
    ]
    for chapter, names in groupby(level_catalog.names(), key=dirname):
        lines += ["", f"## {chapter.capitalize()}"]
        for name in names:
            level = load(level_catalog.find(name))
            lines += ["", f"### {level.title} {{: #{anchor(name)} }}"]
            lines += ["", f"`{name}`: {level.summary}"]
            lines += ["", f"![{level.title}](gallery/{name}.png){{: loading=lazy }}"]
    return "\n".join(lines) + "\n"


def anchor(level: str) -> str:
    """Return what a level is called within the gallery."""
    return level.replace("/", "-")


def draw() -> None:
    """Draw every level that has changed since its picture; without the folder, all of them."""
    os.environ.update(SDL_VIDEODRIVER="dummy", SDL_AUDIODRIVER="dummy")
    from sandbox.app.level_picture import save_picture

    for name in level_catalog.names():
        source, picture = level_catalog.find(name), PICTURES / f"{name}.png"
        if not picture.exists() or picture.stat().st_mtime < source.stat().st_mtime:
            picture.parent.mkdir(parents=True, exist_ok=True)
            level = load(source)
            save_picture(level, level.defaults, picture)
    for page in GUIDE:
        for picture, text in pictures_of(page).items():
            level, target = parse(text, page), PICTURES.parent / picture
            target.parent.mkdir(parents=True, exist_ok=True)
            save_picture(level, level.defaults, target)


def pictures_of(page: str) -> dict[str, str]:
    """Return the levels that a page of the guide shows, by where their pictures are."""
    levels = LEVEL.findall((ROOT / "docs" / page).read_text(encoding="utf-8"))
    return {f"gallery/{Path(page).stem}/{i}.png": text for i, text in enumerate(levels, 1)}


def illustrated(page: str, text: str) -> str:
    """Return a page of the guide with a picture below each level."""
    pictures = iter(pictures_of(page))

    def with_picture(level: re.Match[str]) -> str:
        return f"{level[0]}\n\n![The level in the window](../{next(pictures)}){{: loading=lazy }}"

    return LEVEL.sub(with_picture, text)


def inside(page: str, text: str) -> str:
    """Return a page whose links out of the documents lead to pages of the site.

    Parameters
    ----------
    page
        Its path, from the folder of the documents.
    text
        Its Markdown.
    """

    def leading(link: re.Match[str]) -> str:
        target = normpath(f"{dirname(page)}/{link[1]}") if dirname(page) else normpath(link[1])
        if found := re.fullmatch(r"\.\./levels/(.+)\.json", target):
            target, section = "gallery.md", f"#{anchor(found[1])}"
        else:
            target, section = target.removeprefix("../").removeprefix("docs/"), link[2] or ""
        return f"]({relpath(target, dirname(page) or '.')}{section})"

    return LINK.sub(leading, text)


def on_files(files: "Files", config: "MkDocsConfig") -> "Files":
    """Add the gallery, its pictures, and the documents of the root folder."""
    from mkdocs.structure.files import File

    draw()
    files.append(File.generated(config, "gallery.md", content=gallery()))
    for name in FROM_ROOT:
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    for name in level_catalog.names():
        picture = PICTURES / f"{name}.png"
        files.append(File.generated(config, f"gallery/{name}.png", abs_src_path=str(picture)))
    for picture in chain.from_iterable(map(pictures_of, GUIDE)):
        files.append(File.generated(config, picture, abs_src_path=str(PICTURES.parent / picture)))
    return files


def on_page_markdown(markdown: str, page: "Page", **_: object) -> str:
    """Add the pictures of the guide, and mend the links that lead out of the documents."""
    name = page.file.src_uri
    return inside(name, illustrated(name, markdown) if name in GUIDE else markdown)
