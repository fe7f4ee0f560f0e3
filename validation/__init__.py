"""Comparison of the sandbox's runs with closed forms that are independent of the engine."""
