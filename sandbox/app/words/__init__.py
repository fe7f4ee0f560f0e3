"""The texts of the window in the chosen language, and the formatting of numbers."""
