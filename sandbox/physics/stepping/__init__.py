"""The world: a running scene, its drifts and kicks, and the stages of a step."""
