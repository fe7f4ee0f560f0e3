"""Cards with text and numbers about a run: one module per card."""
