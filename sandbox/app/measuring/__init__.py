"""Measuring tools on the stage, and the mouse there."""
