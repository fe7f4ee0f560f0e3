"""Events at their own times within a step: impacts, ends of slipping, and changes of joints."""
