"""What stops a run that has gone wrong, and knows the rate that it needs."""
