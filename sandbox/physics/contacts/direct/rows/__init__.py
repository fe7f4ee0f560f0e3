"""The rows of a kick: gaps and slips as functions of positions."""
