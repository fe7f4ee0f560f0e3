"""Measuring tools on the stage, and the mouse that uses them."""
