"""The page of the effects, which switches them off and on."""

from sandbox.app.pages.effects import switching_effects
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
            "reset effects",
            "X",
            "reset the effects",
            lambda desk: switching_effects.reset(desk.session),
        ),
    ),
    superimposed_runs=switching_effects.rows,
)
