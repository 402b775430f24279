"""Shared operations of the folders with bpy."""
