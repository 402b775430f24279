"""Every material as albedo and emission (docs/lambert.md)."""
