"""The page of the effects: what if one did not act, or another did."""
