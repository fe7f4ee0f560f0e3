"""What was seen of a run, kept for pages, cards and the stage."""
