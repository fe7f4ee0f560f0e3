"""Named quantities, read from states."""
