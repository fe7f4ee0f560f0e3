"""What a reader wants to know first: a few figures out of many, a file a part of the page."""
