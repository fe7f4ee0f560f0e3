"""Contacts: shapes, coefficients, friction and impacts."""
