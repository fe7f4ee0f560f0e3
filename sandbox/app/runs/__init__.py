"""A level that is played: its runs, the pace of time in them, and the user's actions on them."""
