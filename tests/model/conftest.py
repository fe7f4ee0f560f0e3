"""How hypothesis looks for counterexamples here."""

from hypothesis import settings

# What takes how long is tested by name; a slow machine is no counterexample to anything else.
settings.register_profile("unhurried", deadline=None)
settings.load_profile("unhurried")
