"""Digests of the measurements for the reader, with a module for each part of the page."""
