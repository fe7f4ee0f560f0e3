"""Force laws, one in each file, with force and energy together; and masses that change."""
