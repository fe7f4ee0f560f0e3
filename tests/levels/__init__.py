"""Every level, swept through the same contracts."""
