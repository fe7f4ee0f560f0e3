"""The rules of a level that go beyond the type of each part."""
