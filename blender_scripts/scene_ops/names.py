"""Names that Blender can hold: at most 63 bytes of UTF-8 up to 4.x (it cuts longer ones, half a character included)."""
import hashlib

MOST_BYTES = 63
DIGITS = 8


def fitting(name, taken=()):
    """The name itself, or with a hash of it where it is too long or is taken."""
    if len(name.encode()) <= MOST_BYTES and name not in taken:
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()[:DIGITS]
    return name.encode()[:MOST_BYTES - 1 - DIGITS].decode(errors="ignore") + "~" + digest
