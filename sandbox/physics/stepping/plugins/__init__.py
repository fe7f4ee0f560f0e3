"""The parts of a step that only some levels need, one plugin per file; see `register.py`."""
