"""Drifts that landings cut, or that are subdivided."""
