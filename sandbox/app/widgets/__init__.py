"""What several panels and pages are made of."""
