"""A camera's view (docs/render.md)."""
