"""Joints that hold to rounding: what they say, and how they are solved together."""
