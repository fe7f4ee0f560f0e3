"""The page of the effects, which switches them off and on."""

from sandbox.app.pages.effects import whatif
from sandbox.app.pages.effects.card import changed
from sandbox.app.pages.effects.panel import EffectsPage
from sandbox.app.pages.page import Page, PageCommand

PAGE = Page(
    name="effects",
    caption="Effects",
    key="x",
    text="what if: effects off and on",
    card=changed,
    panel=EffectsPage,
    commands=(
        PageCommand(
            "reset effects", "X", "reset the effects", lambda desk: whatif.reset(desk.session)
        ),
    ),
    beside=whatif.rows,
)
