"""What the folders with bpy share."""
