"""The page of the effects, which switches them off and on."""

from sandbox.app.pages.effects import whatif
from sandbox.app.pages.page import Page, PageCommand, imported

PAGE = Page(
    name="effects",
    caption="Effects",
    key="x",
    text="what if: effects off and on",
    card=imported("sandbox.app.pages.effects.card", "changed"),
    panel=imported("sandbox.app.pages.effects.panel", "EffectsPage"),
    commands=(
        PageCommand(
            "reset effects", "X", "reset the effects", lambda desk: whatif.reset(desk.session)
        ),
    ),
    superimposed_runs=whatif.rows,
)
