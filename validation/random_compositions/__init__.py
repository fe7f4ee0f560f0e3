"""Random compositions of everything that a level may contain, judged without closed forms."""
