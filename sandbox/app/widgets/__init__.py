"""Widgets that are shared by several panels and pages."""
