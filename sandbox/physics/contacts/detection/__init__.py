"""Which bodies touch or overlap, and when they meet."""
