"""Light, into pictures."""
