"""Random compositions of everything that a level may hold, judged without a formula."""
