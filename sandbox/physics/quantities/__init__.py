"""Named quantities, measured from states."""
