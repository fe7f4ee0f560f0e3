"""What moves, frozen: the state at a step, and how it is read."""
