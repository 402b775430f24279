"""One task of the driver: request.json in, result.json out, progress.jsonl on the way.

Blender's stdout carries its banner and its exit code cannot be trusted, so an answer counts only if
result.json holds the nonce of the request. Nothing here needs bpy.
"""
import errno
import json
import os
import sys
import time
import traceback

# base/error.h, ExitCode
USAGE = 1
IO = 2
INVALID_INPUT = 3
ENVIRONMENT = 4
UNSUPPORTED = 5

SCRIPT_FAILED = 86
FULL = (errno.ENOSPC, errno.EDQUOT)
LEAST_SPACE = 1 << 16  # bytes; with less left on a disk it counts as full


class Refusal(Exception):
    """The scene cannot be baked as asked. One line: what, where, and what would mend it."""

    def __init__(self, message, code=INVALID_INPUT, object_name=""):
        super().__init__(message)
        self.code = code
        self.object_name = object_name


class Task:
    def __init__(self, request_file):
        with open(request_file, encoding="utf-8") as stream:
            self.request = json.load(stream)
        self.folder = self.request["folder"]
        self._progress = open(self.path("progress.jsonl"), "a", encoding="utf-8")
        self._events = 0
        with open(self.path("reserve"), "wb") as stream:  # room for an answer on a full disk
            stream.write(bytes(LEAST_SPACE))

    def path(self, name):
        return os.path.join(self.folder, name)

    def progress(self, phase, what="", done=0, total=0, until=0, samples=0):
        """Say what begins now: `done` of `total` lie before it, `until` will when it is finished. `samples`: what
        Cycles will take of its picture. Goes to stdout as well, so that what Blender prints can be told from what
        it printed before."""
        event = {"phase": phase, "what": what, "done": done, "total": total, "until": until, "samples": samples}
        self._progress.write(json.dumps(event) + "\n")
        self._progress.flush()
        self._events += 1
        print("rnmbake: event", self._events, phase, flush=True)

    def wait_for(self, name):
        """The JSON of a file that the driver will write; it ends this process where it ends itself."""
        while not os.path.exists(self.path(name)):
            time.sleep(0.02)
        with open(self.path(name), encoding="utf-8") as stream:
            return json.load(stream)

    def disk_is_full(self, error):
        """Whether `error` means a full disk; Blender's own errors have a message, but no errno."""
        if isinstance(error, OSError) and error.errno in FULL:
            return True
        space = os.statvfs(self.folder)
        free = space.f_frsize * (space.f_bavail if os.geteuid() else space.f_bfree)
        return any(os.strerror(number) in str(error) for number in FULL) or free < LEAST_SPACE

    def full_disk(self):
        return {"refused": {"code": IO, "object": "", "message": f"the disk of {self.folder} is full; free some space, "
                            "or point TMPDIR to a folder on another disk"}}

    def answer(self, content):
        """Write result.json whole or not at all."""
        content["nonce"] = self.request["nonce"]
        os.remove(self.path("reserve"))
        unfinished = self.path("result.json.part")
        with open(unfinished, "w", encoding="utf-8") as stream:
            json.dump(content, stream)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(unfinished, self.path("result.json"))


def run(main):
    """Call main(task), which returns the result as a dict, and turn every outcome into result.json."""
    task = Task(sys.argv[sys.argv.index("--") + 1])
    try:
        outcome = {"ok": main(task)}
        if task.disk_is_full(""):  # pictures that Blender could not write, which it may say nowhere but in a log there
            outcome = task.full_disk()
    except Refusal as refusal:
        outcome = {"refused": {"code": refusal.code, "message": str(refusal), "object": refusal.object_name}}
        if task.disk_is_full(refusal):
            outcome = task.full_disk()
    except Exception as error:  # whatever it is, the driver must hear of it
        outcome = {"failed": {"message": repr(error), "traceback": traceback.format_exc()}}
        if task.disk_is_full(error):
            outcome = task.full_disk()
    task.answer(outcome)
    if "failed" in outcome:
        sys.exit(SCRIPT_FAILED)
