"""Blender runs this before it opens a .blend that nobody vouched for: opening/untrusted.py."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from opening import untrusted  # noqa: E402

untrusted.watch()
