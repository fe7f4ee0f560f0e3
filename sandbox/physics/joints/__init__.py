"""Joints between bodies: exact ones, pymunk's own, and welds into one solid."""
