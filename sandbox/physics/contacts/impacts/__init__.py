"""Impacts at a step, and the velocities of contact points."""
