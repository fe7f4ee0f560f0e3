"""The picture of a world: grid and rulers, surfaces, bodies, joints, and overlays."""
