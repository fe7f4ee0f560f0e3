"""The closed forms and the cases."""
