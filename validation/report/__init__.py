"""All of the validation as one self-contained page."""
