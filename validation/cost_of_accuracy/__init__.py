"""The cost of accuracy: error against seconds, for every level, scheme and rate."""
