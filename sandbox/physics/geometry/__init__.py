"""Geometry of outlines: distances, contacts on arcs and curves, convex decomposition."""
