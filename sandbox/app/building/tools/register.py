"""The list of tools, from which the palette, the keys and the help are derived."""

from sandbox.app.building.tools.deleting import DeleteTool
from sandbox.app.building.tools.discs_and_boxes import BoxTool, DiscTool
from sandbox.app.building.tools.joining import JoinTool
from sandbox.app.building.tools.selecting import SelectTool
from sandbox.app.building.tools.surfaces_and_polygons import CurveTool, PolygonTool, SurfaceTool
from sandbox.app.building.tools.tool import ToolDeclaration

TOOLS: tuple[ToolDeclaration, ...] = (
    ToolDeclaration("select", "Select", "1", "select, move, turn and resize", SelectTool),
    ToolDeclaration(
        "disc", "Disc", "2", "draw discs: press at the centre, drag to the rim", DiscTool
    ),
    ToolDeclaration("box", "Box", "3", "draw boxes, from corner to corner", BoxTool),
    ToolDeclaration("polygon", "Polygon", "4", "draw polygons, a click a corner", PolygonTool),
    ToolDeclaration("surface", "Surface", "5", "draw floors, slopes and walls", SurfaceTool),
    ToolDeclaration("curve", "Freehand", "6", "draw what you like", CurveTool),
    ToolDeclaration("join", "Joint", "7", "tie bodies together, or to the plane", JoinTool),
    ToolDeclaration("delete", "Delete", "8", "delete what is clicked on", DeleteTool),
)
"""All tools in the order of the palette; the first is active at first."""


def kind(name: str) -> ToolDeclaration:
    """Return the tool of a name."""
    return next(each for each in TOOLS if each.name == name)
