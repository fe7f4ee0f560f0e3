"""pymunk's own objects: bodies and contacts in arrays, and what is called within a step."""
