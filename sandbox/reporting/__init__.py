"""What all reports share: the style of figures, and their embedding in pages."""
