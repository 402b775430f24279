"""No bpy in here."""
