"""Complementarity problems, as matrices and vectors; no body is known here."""
