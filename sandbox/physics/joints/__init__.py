"""What joins bodies: exactly, as pymunk does, or as one."""
