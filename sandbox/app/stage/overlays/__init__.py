"""What explains a motion, drawn over the scene: a module an overlay."""
