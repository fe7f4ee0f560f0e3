"""The levels as cards, with pictures of them."""
