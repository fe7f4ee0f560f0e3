"""The hard cases: scenes that break rigid-body engines, and how far this one gets."""
