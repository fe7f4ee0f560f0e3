"""Force laws, one a file, with the energy beside the force; and masses that change."""
