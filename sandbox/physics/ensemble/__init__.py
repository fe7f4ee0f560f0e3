"""Many runs of a level at once, in shared arrays, with the same bits as each run alone."""
