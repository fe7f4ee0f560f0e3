"""Guards that stop a run that has gone wrong, and advise the rate that it needs."""
