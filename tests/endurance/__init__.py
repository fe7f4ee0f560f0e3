"""What takes too long for a test: `make soak` and `make faults` run it, and print what they saw."""
