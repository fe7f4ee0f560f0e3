"""How hypothesis looks for counterexamples."""

from hypothesis import settings

# A slow machine is no counterexample.
settings.register_profile("unhurried", deadline=None)
settings.load_profile("unhurried")
