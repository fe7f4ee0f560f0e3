"""Which version of the sandbox this is."""

__version__ = "0.1.0"
