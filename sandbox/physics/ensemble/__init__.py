"""Many runs of a level at once, in arrays over all of them, to the bits of each run alone."""
