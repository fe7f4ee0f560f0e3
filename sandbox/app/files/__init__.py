"""What is kept in a person's own files, from one day to the next."""
