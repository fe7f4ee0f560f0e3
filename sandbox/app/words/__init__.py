"""What the window says, in the language that is chosen, and how numbers are put."""
