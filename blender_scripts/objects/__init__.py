"""Plain objects in place of instances, curves and the like."""
