"""What accuracy costs in time: error against seconds, for every level, scheme and rate."""
