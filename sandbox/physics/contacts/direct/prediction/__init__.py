"""What will touch, or come off, within the drift after a kick."""
