"""Requests for accuracies of levels at random parameters, and their results."""
