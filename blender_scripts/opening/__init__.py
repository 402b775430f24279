"""Checks of the open scene, before anything is done with it."""
