"""The picture of a world: grid and rulers, surfaces, bodies, strings, and what explains them."""
