"""Says what is going on, at least every ten seconds."""
import sys
import threading
import time

SILENCE = 8.0  # s


class Progress:
    """Notes are kept: they go into the file beside the mesh."""

    def __init__(self, program="tunica-lumen"):
        self.notes, self._stage, self._program = [], "starting", program
        self._begin = self._last = time.monotonic()
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _line(self, text, stream=None):
        self._last = time.monotonic()
        print(text, file=stream or sys.stdout, flush=True)

    def _watch(self):
        while not self._done.wait(1.0):
            if time.monotonic() - self._last > SILENCE:
                self._line(f"{self._clock()} ... {self._stage}")

    def _clock(self):
        return f"{time.monotonic() - self._begin:6.1f} s"

    def stage(self, text):
        self._stage = text
        self._line(f"{self._clock()} {text}")

    def beat(self, text):
        """A line only where the last one is old."""
        self._stage = text
        if time.monotonic() - self._last > 0.6 * SILENCE:
            self._line(f"{self._clock()} ... {text}")

    def say(self, text):
        self._line(f"         {text}")

    def note(self, text):
        """What was found amiss or mended."""
        self.notes.append(text)
        self._line(f"         {text}")

    def warn(self, text):
        self.notes.append(text)
        self._line(f"{self._program}: {text}", sys.stderr)

    def seconds(self):
        return time.monotonic() - self._begin

    def stop(self):
        self._done.set()
        self._thread.join()
