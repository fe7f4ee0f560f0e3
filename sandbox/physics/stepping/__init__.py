"""The world: a running scene, its drifts and kicks, and the plugins of a step."""
