"""The rules of a level that go beyond the types of its parts."""
