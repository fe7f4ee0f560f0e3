"""What helps: found before a run, and tried after one that had to stop."""
