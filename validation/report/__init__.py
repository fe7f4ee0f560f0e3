"""All of the validation as one page that needs nothing but itself."""
