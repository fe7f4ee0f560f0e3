"""The page of the schemes that race."""
