"""The scene with lightmap UVs that users get."""
