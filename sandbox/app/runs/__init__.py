"""A level that is played: its runs, how time passes in them, and what is done to them."""
