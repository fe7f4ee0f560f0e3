"""The home page: levels as cards with pictures."""
