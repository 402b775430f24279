"""What a render would show, as data."""
