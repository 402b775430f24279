"""The saved scene, into files for engines."""
