"""From the rows of a kick to its impulses."""
