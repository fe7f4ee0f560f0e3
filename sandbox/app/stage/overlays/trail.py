"""The overlay with the paths of bodies."""

from sandbox.app.stage.overlays.overlay import Overlay

OVERLAY = Overlay(name="trail", key="t", text="trail", draw_trail=True, caption="Trail")
