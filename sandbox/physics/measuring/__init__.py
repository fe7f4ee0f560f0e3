"""Runs in numbers: quantities, records, grades, differences, files and times."""
