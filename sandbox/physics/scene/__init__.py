"""From a level to a pymunk space, and which schemes and rates may run it."""
