"""What happens within a step, at its own time: impacts, and the ends of slipping."""
