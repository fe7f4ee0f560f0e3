"""Basics of drawing: the camera from metres to pixels, colours, lines and text."""
