"""Dispatches events: keys, clicks and dropped files go to their handlers."""

from pathlib import Path

import pygame

from sandbox.app.command_actions import CommandActions
from sandbox.app.home.unfinished_work_strip import Unsaved
from sandbox.app.keymap import command
from sandbox.app.open_level_and_panels import OpenLevelAndPanels
from sandbox.app.pages.build import PAGE as BUILD_PAGE
from sandbox.app.runs.crash_recovery import LeftRun
from sandbox.app.runs.session import Session
from sandbox.app.widgets.parameter_sliders import Change
from sandbox.app.window_keys import WHILE_TYPING
from sandbox.app.words.language import say
from sandbox.model.atomic_file_writing import without_links
from sandbox.model.errors import SandboxError

_MOUSE = (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION)


class InputEventDispatch:
    """Passes each event to the widgets, the home page, the commands, or the stage."""

    def __init__(self, workspace: OpenLevelAndPanels, commands: CommandActions) -> None:
        self._space, self._commands = workspace, commands

    def handle(self, event: pygame.event.Event) -> None:
        """Handle an event."""
        space = self._space
        if event.type == pygame.QUIT:
            space.open = False
        elif event.type == pygame.VIDEORESIZE:
            space.surface = pygame.display.get_surface() or space.surface
            space.lay_out()
        elif event.type == pygame.DROPFILE:
            space.open_file(without_links(Path(event.file)))
        elif self._change(event) or self._zoom_page(event):
            return
        elif event.type == pygame.MOUSEBUTTONDOWN and space.panels.focus.leave():
            self.handle(event)
        elif event.type == pygame.KEYDOWN:
            self._key(event)
        elif not space.panels.manager.process_events(event) and not self._at_home(event):
            self._click(event)

    def _zoom_page(self, event: pygame.event.Event) -> bool:
        """Pass an event to the page for zooming, and return whether it was handled."""
        panels = self._space.panels
        typed = panels.typing and event.type == pygame.KEYDOWN
        busy = typed or panels.dialog is not None
        return panels.side is not None and not busy and panels.side.zoom_page(event)

    def leave_fields(self) -> None:
        """Apply what was typed into a field that has lost the focus."""
        side = self._space.panels.side
        if side is not None and (change := side.parameters.left_field_change()):
            self._set(change)

    def _at_home(self, event: pygame.event.Event) -> bool:
        """Pass an event to the home page, if it is shown, and return whether it was handled."""
        home = self._space.panels.home
        if not home.open or self._space.panels.dialog is not None or not home.process(event):
            return False
        if home.chosen is not None:
            path, home.chosen = home.chosen, None
            self._space.open_file(path)
        elif home.recovered is not None:
            left, home.recovered = home.recovered, None
            self._recover(left)
        return True

    def _recover(self, left: Unsaved) -> None:
        """Continue with a draft or a run that was not saved."""
        if isinstance(left, LeftRun):
            self._space.continue_run(left)
            return
        from sandbox.app.building.draft_recovery_and_conflict_choices import recover
        from sandbox.app.building.editor import Editor

        self._commands.do(BUILD_PAGE.command)
        if self._space.session is not None:
            recover(left, self._space.workers.of(Editor), self._space.session)

    def _key(self, event: pygame.event.Event) -> None:
        space, panels = self._space, self._space.panels
        plays = self._is_play_key(event)
        if plays:  # the number is taken, and letters are commands again
            panels.manager.set_focus_set(None)
        typing = not plays and (panels.typing or self._begin_answer(event))
        if panels.focus.key(panels.manager, panels.layout, event):
            return
        if not typing and self._at_home(event):
            return
        chosen, maker, session = command(event), space.stage_tool, space.session
        free = not (typing or space.help or space.panels.home.open)
        if free and maker is not None and session is not None and maker.key(event, session):
            return
        if chosen and (not typing or chosen in WHILE_TYPING):
            self._commands.do(chosen)
        else:
            space.panels.manager.process_events(event)

    def _is_play_key(self, event: pygame.event.Event) -> bool:
        """Whether a key is Space after the number of a parameter, which begins no other number."""
        side = self._space.panels.side
        return event.key == pygame.K_SPACE and side is not None and side.parameters.selected

    def _begin_answer(self, event: pygame.event.Event) -> bool:
        """Let a key begin the answer to a question of the page, and return whether it does."""
        panels, side = self._space.panels, self._space.panels.side
        hidden = self._space.help or panels.home.open
        return side is not None and not hidden and side.focus_answer_field(event)

    def _click(self, event: pygame.event.Event) -> None:
        """Pass an event to the list, the controls, the side panel, or the stage."""
        space = self._space
        if path := space.panels.chosen_level(event):
            space.open_file(without_links(path))
        elif space.panels.accepts_offer(event):
            space.run_as_advised()
        elif chosen := space.panels.pressed(event):
            self._commands.do(chosen)
        elif self._seek(event) or self._click_side(event):
            return
        elif space.session is not None:
            self._act_on_stage(event, space.session)

    def _act_on_stage(self, event: pygame.event.Event, session: Session) -> None:
        """Pass a mouse event to the page's tool on the stage, or to the hand."""
        space, maker = self._space, self._space.stage_tool
        space.follow(session)  # an earlier event may have restarted it
        mouse, area = pygame.mouse.get_pos(), space.panels.layout.stage
        if event.type == pygame.MOUSEWHEEL and area.collidepoint(mouse):
            space.hand.wheel(event.precise_y, mouse, area)
        elif event.type in _MOUSE and not (
            maker is not None and maker.process(event, area, space.stage, session)
        ):
            try:
                space.hand.process(event, area, session)
            except SandboxError as error:
                space.banner.write(say(error.message))

    def _seek(self, event: pygame.event.Event) -> bool:
        """Go to the time that was clicked or dragged to on the time bar; return whether one was."""
        share, session = self._space.panels.controls.clicked_share(event), self._space.session
        if share is None or session is None:
            return share is not None
        try:
            session.go_to(round(share * session.span))
        except SandboxError as error:
            self._space.banner.write(say(error.message))
        return True

    def _click_side(self, event: pygame.event.Event) -> bool:
        """Pass an event to the side panel, and return whether it was handled."""
        side = self._space.panels.side
        if side is None:
            return False
        if wanted := side.process(event):
            self._commands.do(wanted)
            return True
        answer = side.act(event)
        if answer is not None:
            self._space.banner.write(answer)
        return answer is not None

    def _change(self, event: pygame.event.Event) -> bool:
        """Change a parameter if an event is for its slider or field; return whether it is."""
        side = self._space.panels.side
        change = side.parameters.process(event) if side is not None else None
        if change is not None:
            self._set(change)
        return change is not None

    def _set(self, change: Change) -> None:
        """Change a parameter, from the start or from now on; say beside it if that fails."""
        session, side, banner = self._space.session, self._space.panels.side, self._space.banner
        assert session is not None
        assert side is not None
        refusal = change.refusal
        if change.value is not None and change.value != session.chosen[change.name]:
            try:
                session.change({change.name: change.value}, otherwise=change.with_shift)
                banner.write("")
            except SandboxError as error:
                refusal = error.message
        side.parameters.show(session.chosen)
        side.parameters.revert()
        side.parameters.accept()
        if refusal:
            side.parameters.refuse(change.name, say(refusal))
