"""Accuracies asked of levels at random parameters, and what is delivered."""
