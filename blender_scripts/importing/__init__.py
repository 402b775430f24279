"""Files that are no .blend."""
