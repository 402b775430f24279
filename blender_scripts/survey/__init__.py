"""The scene survey."""
