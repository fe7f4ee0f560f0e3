"""The toolbox: which tool is in hand, and what it changes, the level or its run."""

from sandbox.app.building.edited_level import Work
from sandbox.app.building.tools.joining import JoinTool
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.building.tools.tool import Tool

FIRST = TOOLS[0].name
"""The tool that selects, which is active at first."""


class Toolbox:
    """The tools, a set for each thing that they change.

    Attributes
    ----------
    bench
        What the tools change: the level, or its run.
    tool
        The name of the tool in hand.
    """

    def __init__(self, level: Work, run: Work) -> None:
        self.bench, self.tool = level, FIRST
        self._run = run
        self._tools = {
            bench: {kind.name: kind.make(bench) for kind in TOOLS} for bench in (level, run)
        }
        self._laid_down = FIRST  # while the run is shown

    @property
    def hand(self) -> Tool:
        """The tool in hand."""
        return self._tools[self.bench][self.tool]

    @property
    def joining(self) -> JoinTool:
        """The tool that makes joints."""
        tool = self._tools[self.bench]["join"]
        assert isinstance(tool, JoinTool)
        return tool

    def choose(self, tool: str) -> None:
        """Take a tool in hand."""
        self.cancel()
        self.tool = tool
        self.bench.show()

    def cancel(self) -> None:
        """Cancel what was begun."""
        while self.hand.busy:
            self.hand.cancel()

    def give_up(self) -> None:
        """Cancel what was begun; else deselect everything; else take the first tool."""
        if self.hand.busy:
            self.hand.cancel()
        elif self.bench.selected:
            self.bench.select(())
        else:
            self.choose(FIRST)

    def turn_to(self, bench: Work) -> None:
        """Change the level or the run from now on; in the run the mouse is a hand at first."""
        self.cancel()
        self.bench = bench
        if bench is self._run:
            self.tool, self._laid_down = FIRST, self.tool
        else:
            self.tool = self._laid_down
