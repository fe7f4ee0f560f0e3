"""The page of the race between schemes."""

from sandbox.app.pages.page import Page, PageCommand, imported
from sandbox.app.pages.scheme_race import scheme_comparison

PAGE = Page(
    name="scheme_race",
    caption="Race",
    key="s",
    text="race: every scheme at once",
    card=imported("sandbox.app.pages.scheme_race.card", "standing"),
    panel=imported("sandbox.app.pages.scheme_race.panel", "RacePage"),
    commands=(
        PageCommand(
            "race",
            "S",
            "start the race, or end it",
            lambda desk: scheme_comparison.start_or_end(desk.session),
        ),
    ),
    superimposed_runs=scheme_comparison.rows,
)
