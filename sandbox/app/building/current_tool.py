"""The current tool of the editor, and what it changes: the level or its run."""

from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.tools.joining import JoinTool
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.building.tools.tool import Tool

FIRST = TOOLS[0].name
"""The tool that selects, which is active at first."""


class CurrentTool:
    """The tools: one set for the level, and one for its run."""

    def __init__(self, level: EditedLevel, run: EditedLevel) -> None:
        self.bench = level
        """The level or its run, whichever the tools change."""
        self.tool = FIRST
        """The name of the current tool."""
        self._run = run
        self._tools = {
            bench: {kind.name: kind.make(bench) for kind in TOOLS} for bench in (level, run)
        }
        self._laid_down = FIRST  # the level's tool while the run is shown

    @property
    def hand(self) -> Tool:
        """The current tool."""
        return self._tools[self.bench][self.tool]

    @property
    def joining(self) -> JoinTool:
        """The tool that makes joints."""
        tool = self._tools[self.bench]["join"]
        assert isinstance(tool, JoinTool)
        return tool

    def choose(self, tool: str) -> None:
        """Make a tool the current one."""
        self.cancel()
        self.tool = tool
        self.bench.show()

    def cancel(self) -> None:
        """Cancel what is being drawn."""
        while self.hand.busy:
            self.hand.cancel()

    def give_up(self) -> None:
        """Cancel what is being drawn; else deselect everything; else choose the first tool."""
        if self.hand.busy:
            self.hand.cancel()
        elif self.bench.selected:
            self.bench.select(())
        else:
            self.choose(FIRST)

    def turn_to(self, bench: EditedLevel) -> None:
        """Let the tools act on the level or the run; in the run the first tool is chosen."""
        self.cancel()
        self.bench = bench
        if bench is self._run:
            self.tool, self._laid_down = FIRST, self.tool
        else:
            self.tool = self._laid_down
