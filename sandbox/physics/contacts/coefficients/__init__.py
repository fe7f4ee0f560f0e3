"""The coefficients of pairs, and static friction."""
