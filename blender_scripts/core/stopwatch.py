"""Wall-clock seconds, split into laps."""
import time


class Stopwatch:
    def __init__(self):
        self._last = time.monotonic()

    def lap(self):
        """Seconds since the last lap, or since the start."""
        before, self._last = self._last, time.monotonic()
        return self._last - before
