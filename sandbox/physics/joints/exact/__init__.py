"""Joints that hold to rounding: their equations, and solvers for them."""
