"""The whole validation as one self-contained page."""
