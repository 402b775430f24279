"""Node groups that decode lightmaps (docs/shaders.md)."""
