"""Books of energy and momentum, kept from the records of steps."""
