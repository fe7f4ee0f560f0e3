"""The page of the accuracy: what the next digit costs."""
