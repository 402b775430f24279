"""Plain objects in place of what a render shows."""
