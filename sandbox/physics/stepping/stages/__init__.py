"""The parts of a step that only some levels need, one stage per file; see `register.py`."""
