"""Overlays, which explain the motion and are drawn over the scene: one module for each."""
