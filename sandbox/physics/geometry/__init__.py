"""Outlines: how far they are from each other, arcs and curves among them, and convex parts."""
