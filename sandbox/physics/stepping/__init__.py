"""A scene that runs, step by step."""
