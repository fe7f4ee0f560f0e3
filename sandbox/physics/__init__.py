"""From a level to a world: building, stepping, measuring. Only here is pymunk imported."""
