"""What all that is drawn is made of: the way from metres to pixels, colours, lines, letters."""
