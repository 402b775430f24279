"""One task of the driver: request.json in, result.json out, progress.jsonl on the way.

Blender's stdout carries its banner and its exit code cannot be trusted, so an answer counts only if
result.json holds the nonce of the request. Nothing here needs bpy.
"""
import json
import os
import sys
import traceback

# base/error.h, ExitCode
IO = 2
INVALID_INPUT = 3
ENVIRONMENT = 4
UNSUPPORTED = 5

SCRIPT_FAILED = 86


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

    def path(self, name):
        return os.path.join(self.folder, name)

    def progress(self, phase, what="", done=0, total=0):
        event = {"phase": phase, "what": what, "done": done, "total": total}
        self._progress.write(json.dumps(event) + "\n")
        self._progress.flush()

    def answer(self, content):
        """Write result.json whole or not at all."""
        content["nonce"] = self.request["nonce"]
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
        task.answer({"ok": main(task)})
    except Refusal as refusal:
        task.answer({"refused": {"code": refusal.code, "message": str(refusal), "object": refusal.object_name}})
    except Exception as error:  # whatever it is, the driver must hear of it
        task.answer({"failed": {"message": repr(error), "traceback": traceback.format_exc()}})
        sys.exit(SCRIPT_FAILED)
