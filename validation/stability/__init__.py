"""The hard cases: where rigid-body engines break, and how far this one goes before it does."""
