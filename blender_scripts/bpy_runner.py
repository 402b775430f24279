"""Blender's command line for a Blender that is the Python module bpy:

    python bpy_runner.py [-b] [-Y | -y] [-t N] [--python-exit-code N] [FILE.blend] [--python SCRIPT] [--version] [-- ...]

Takes the words that rnmbake uses, in their order, as `blender` does; of others it says that it does not know them. What
Blender does for itself is done here: whether scripts of a file may run, threads, sys.argv, exit codes.
"""
import ctypes
import importlib
import os
import runpy
import sys
import traceback

# Of no meaning to the module: it has no windows, begins with factory settings where HOME is empty, and is not online.
IGNORED = {"-b", "--background", "--factory-startup", "-noaudio", "--offline-mode"}
IGNORED_WITH_VALUE = {"--verbose", "--log", "--log-level"}  # Cycles is asked to speak by GLOG_v
CANNOT_OPEN = 1


class Runner:
    def __init__(self):
        self.allow_scripts = False
        self.threads = 0
        self.exit_code = 0  # of a script that fails

    def run(self, words):
        own = iter(words[:words.index("--")] if "--" in words else words)
        for word in own:
            if word in IGNORED:
                continue
            if word in IGNORED_WITH_VALUE:
                next(own)
            elif word in ("-y", "-Y"):
                self.allow_scripts = word == "-y"
            elif word in ("-t", "--threads"):
                self.threads = int(next(own))
                self.settle()
            elif word == "--python-exit-code":
                self.exit_code = int(next(own))
            elif word in ("-P", "--python"):
                self.script(next(own))
            elif word in ("-v", "--version"):
                say_version()
            elif word.startswith("-"):
                sys.exit(f"bpy_runner.py does not know {word}")
            else:
                self.open(word)

    def open(self, path):
        import bpy
        try:
            bpy.ops.wm.open_mainfile(filepath=os.path.abspath(path), load_ui=True, use_scripts=self.allow_scripts)
        except RuntimeError as error:
            print(error, file=sys.stderr)
            sys.exit(CANNOT_OPEN)
        self.settle()

    def settle(self):
        import bpy
        bpy.context.preferences.filepaths.use_scripts_auto_execute = self.allow_scripts
        for scene in bpy.data.scenes if self.threads else ():
            scene.render.threads_mode, scene.render.threads = "FIXED", self.threads

    def script(self, path):
        """Errors of it are told as Blender tells them; nothing after it runs then, if an exit code was asked for."""
        try:
            runpy.run_path(path, run_name="__main__")
        except SystemExit:
            raise
        except BaseException:
            traceback.print_exc()
            if self.exit_code:
                sys.exit(self.exit_code)


def say_version():
    import bpy
    print("Blender", bpy.app.version_string)
    for name in ("date", "hash", "platform"):
        print(f"\tbuild {name}: {getattr(bpy.app, 'build_' + name).decode(errors='replace')}")


def main():
    words = sys.argv[1:]
    sys.argv = ["blender", *words]
    code = 0
    try:
        importlib.import_module("bpy")  # before all else: with it come the modules of Blender's own scripts
        Runner().run(words)
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
    sys.stdout.flush()
    sys.stderr.flush()
    ctypes.CDLL(None).fflush(None)  # what Blender has printed: C keeps it where it goes into a file
    os._exit(code)  # taking the module down may crash, and nothing is left to be done


if __name__ == "__main__":
    main()
