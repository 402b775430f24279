"""Arrays of numbers that the driver wrote."""
from array import array


def read_floats(stream, count):
    values = array("f")
    values.fromfile(stream, count)
    return values
