"""Completion by real shells: what `rnmbake completion` prints, driven as a person's Tab would.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/shell/completion_check.py
"""
import os
from pathlib import Path
import pty
import re
import shutil
import subprocess
import tempfile
import time
import unittest

BINARY = os.environ["RNMBAKE_BINARY"]
FILES = ("hall.blend", "hall light.blend", "hall.toml", "hall.glb", "hall.txt", "lit.exr", "bricks.png")
LIMIT_SECONDS = 60


def script(shell):
    return subprocess.run([BINARY, "completion", shell], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout


def help_of(*command):
    return subprocess.run([BINARY, *command, "--help"], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout


def commands_in_help(*command):
    listed = help_of(*command).split("Subcommands:\n")[1].split("\n\n")[0]
    return {line.split()[0] for line in listed.splitlines() if re.match(r"  \S", line)}


def flags_in_help(*command):
    """Names in the left column, with both forms of switches."""
    names = set()
    for line in help_of(*command).splitlines():
        if not re.match(r"    -", line):
            continue
        for name in re.findall(r"(?<![\w|])--?(?:\[no-\])?[a-zA-Z][\w-]*", re.split(r"\s{2,}", line.strip())[0]):
            names.add(name.replace("[no-]", ""))
            if "[no-]" in name:
                names.add(name.replace("[no-]", "no-"))
    return names


class Shell:
    """What each shell has to offer; `offered(line)` is the shell's own."""

    @classmethod
    def setUpClass(cls):
        if not shutil.which(cls.shell):
            raise unittest.SkipTest(f"SKIPPED: no {cls.shell} on this machine")
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-complete-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.place = cls.folder / "work"
        (cls.place / "maps").mkdir(parents=True)
        for name in FILES:
            (cls.place / name).touch()
        cls.script = cls.folder / cls.file
        cls.script.write_text(script(cls.shell), encoding="utf-8")

    def test_commands(self):
        offered = self.offered("rnmbake ")
        self.assertLessEqual(commands_in_help(), offered)
        self.assertIn("bake", offered)
        self.assertEqual(self.offered("rnmbake val"), {"validate"})

    def test_tools_below_a_command(self):
        for command in ("ssbump", "cache"):
            self.assertLessEqual(commands_in_help(command), self.offered(f"rnmbake {command} "))

    def test_every_flag_of_every_command(self):
        for command in [(name,) for name in sorted(commands_in_help())] + [("ssbump", "mip"), ("ssbump", "info")]:
            offered = self.offered(f"rnmbake {' '.join(command)} --")
            wanted = {flag for flag in flags_in_help(*command) if flag.startswith("--")}
            self.assertEqual(wanted - offered, set(), command)
            self.assertIn("--quiet", offered, "a flag of the program")

    def test_a_flag_begun(self):
        self.assertEqual(self.offered("rnmbake bake --texels"), {"--texels-per-unit"})
        self.assertEqual(self.offered("rnmbake ssbump info --samp"), set())

    def test_choices(self):
        self.assertEqual(self.offered("rnmbake bake --depth "), {"half", "float"})
        self.assertEqual(self.offered("rnmbake bake --recipe f"), {"flat-normal-map"})
        self.assertEqual(self.offered("rnmbake --log-format "), {"text", "jsonl"})
        self.assertEqual(self.offered("rnmbake completion "), {"bash", "zsh", "fish"})
        self.assertEqual(self.offered("rnmbake probes hall.blend --by "), {"reference", "blender"})

    def test_choices_after_an_equals_sign(self):
        self.assertEqual({word.split("=")[-1] for word in self.offered("rnmbake bake --depth=")}, {"half", "float"})

    def test_scenes(self):
        offered = {word.rstrip("/").replace("\\ ", " ") for word in self.offered("rnmbake bake ")}
        self.assertLessEqual({"hall.blend", "hall light.blend", "hall.toml", "hall.glb", "maps"}, offered)
        self.assertFalse({"hall.txt", "lit.exr"} & offered)

    def test_the_scene_of_a_flag_before_it(self):
        self.assertIn("hall.blend", self.offered("rnmbake bake --samples 4 hall.b"))
        self.assertEqual(self.offered("rnmbake bake --objects bake --depth h"), {"half"}, "bake is a value here")

    def test_folders(self):
        offered = {word.rstrip("/") for word in self.offered("rnmbake ssbump mip bricks.png -o ")}
        self.assertIn("bricks.png", offered)
        self.assertEqual({word.rstrip("/") for word in self.offered("rnmbake compare a b -o ")}, {"maps"})

    def test_no_flag_where_a_number_stands(self):
        self.assertEqual(self.offered("rnmbake bake --samples "), set())


class Bash(Shell, unittest.TestCase):
    shell, file = "bash", "rnmbake"

    def offered(self, line):
        words = line.replace("=", " = ").split()
        if line[-1] in " =":
            words.append("=" if line.endswith("=") else "")
            words = words[:-2] + words[-1:] if line.endswith("=") else words
        program = 'set -eu; source "$1"; shift; set +e\n' \
                  '[[ $(complete -p rnmbake) == "complete -F "*" rnmbake" ]] || exit 9\n' \
                  'name=$(complete -p rnmbake); name=${name#complete -F }; name=${name% rnmbake}\n' \
                  'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); "$name"; ((${#COMPREPLY[@]})) && printf "%s\\n" "${COMPREPLY[@]}"; exit 0'
        done = subprocess.run(["bash", "--norc", "--noprofile", "-c", program, "bash", self.script, *words], cwd=self.place,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        return set(done.stdout.splitlines())

    def test_several_choices_of_a_list(self):
        self.assertEqual(self.offered("rnmbake probes hall.blend --to threejs,bev"), {"threejs,bevy"})

    def test_a_line_without_the_program_in_lower_case_letters(self):
        self.assertEqual(subprocess.run(["bash", "-n", self.script]).returncode, 0)


class Fish(Shell, unittest.TestCase):
    shell, file = "fish", "rnmbake.fish"

    def offered(self, line):
        done = subprocess.run(["fish", "--no-config", "-c", 'source $argv[1]; complete -C $argv[2]', str(self.script), line],
                              cwd=self.place, env={**os.environ, "HOME": str(self.folder)}, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        return {one.split("\t")[0] for one in done.stdout.splitlines()}

    def test_help_texts(self):
        done = subprocess.run(["fish", "--no-config", "-c", 'source $argv[1]; complete -C "rnmbake bake --samp"', str(self.script)],
                              stdout=subprocess.PIPE, encoding="utf-8", check=True)
        self.assertRegex(done.stdout, r"--samples\t\w+")


class Zsh(Shell, unittest.TestCase):
    shell, file = "zsh", "_rnmbake"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.answers = cls.folder / "answers"
        setup = cls.folder / "setup.zsh"
        setup.write_text(f"""
PROMPT='' ; unsetopt zle_bracketed_paste ; unset zle_bracketed_paste
fpath=({cls.folder} $fpath)
autoload -U compinit && compinit -u -D
zstyle ':completion:*' menu no
setopt no_list_beep no_beep no_auto_list no_auto_menu
compadd() {{
  if [[ ${{@[1,(i)(-|--)]}} == *-(O|A|D)\\ * ]]; then builtin compadd "$@"; return $?; fi
  local -a hits
  builtin compadd -O hits "$@"
  (( $#hits )) && print -rl -- $hits >> {cls.answers}
  builtin compadd "$@"
}}
offer() {{ zle complete-word; zle kill-whole-line; print -r -- '::done' >> {cls.answers} }}
zle -N offer
bindkey '^I' offer
cd {cls.place}
print -r -- '::done' >> {cls.answers}
""", encoding="utf-8")
        cls.pid, cls.terminal = pty.fork()
        if cls.pid == 0:
            os.execvpe("zsh", ["zsh", "-f", "-i"], {**os.environ, "TERM": "vt100", "HOME": str(cls.folder)})
        os.set_blocking(cls.terminal, False)
        cls.addClassCleanup(cls.end)
        cls.answer(f"source {setup}\n")

    @classmethod
    def end(cls):
        os.close(cls.terminal)
        os.waitpid(cls.pid, 0)

    @classmethod
    def answer(cls, typed):
        """What the shell wrote until it was done."""
        cls.answers.write_text("")
        os.write(cls.terminal, typed.encode())
        until, shown = time.monotonic() + LIMIT_SECONDS, b""
        while time.monotonic() < until:
            try:
                shown += os.read(cls.terminal, 1 << 16)
            except BlockingIOError:
                pass
            said = cls.answers.read_text(encoding="utf-8").splitlines()
            if said and said[-1] == "::done":
                return set(said[:-1])
            time.sleep(0.01)
        raise AssertionError(f"zsh did not answer to {typed!r}: {shown[-2000:]!r}")

    def offered(self, line):
        return {word.rstrip("=") for word in self.answer(line + "\t")}


if __name__ == "__main__":
    unittest.main()
