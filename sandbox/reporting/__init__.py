"""What all reports share: how figures look, and how they stand in a page."""
