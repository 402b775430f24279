"""A lambert scene for the tracer (docs/export.md)."""
