"""What is told in words and numbers about a run; a file a page."""
