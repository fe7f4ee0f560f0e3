"""Makes a pymunk space from a level, and checks schemes and rates."""
