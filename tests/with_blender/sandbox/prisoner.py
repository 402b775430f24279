"""A text that runs when its .blend is opened, and tries what the scene of a stranger may try. Its findings lie in the
launch's folder. A text beside it, by sandbox_scene.py, says which case this is, and where things are."""
import json
import os
import socket
import subprocess
import sys

import bpy

CASE, PLACES = json.loads(bpy.data.texts["case"].as_string())
FOLDER = os.path.dirname(sys.argv[-1])


def tried(action):
    try:
        return [True, str(action())]
    except Exception as error:
        return [False, repr(error)]


def write(path):
    with open(path, "a") as stream:
        stream.write("a stranger was here")


def read(path):
    with open(path, errors="replace") as stream:
        return stream.read()


def reach(port):
    with socket.create_connection(("127.0.0.1", port), timeout=5) as connection:
        connection.sendall(b"a stranger calls")


def outlive(mark):
    """In a session of its own, with no parent, and with nothing in its environment that says whose it is."""
    subprocess.Popen(["/bin/sh", "-c", f"/bin/sleep 6; echo here > {mark}"], env={}, start_new_session=True,
                     stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def seen_processes():
    return len([name for name in os.listdir("/proc") if name.isdigit()])


if CASE == "escape":
    findings = {
        "write beside": tried(lambda: write(PLACES["beside"])),
        "write outside": tried(lambda: write(PLACES["outside"])),
        "write tmp": tried(lambda: write("/tmp/rnmbake-sandbox-check")),
        "write usr": tried(lambda: write("/usr/rnmbake-sandbox-check")),
        "write etc": tried(lambda: write("/etc/rnmbake-sandbox-check")),
        "write dev": tried(lambda: write("/dev/shm/rnmbake-sandbox-check")),
        "read home": tried(lambda: read(PLACES["home"])),
        "read secret": tried(lambda: os.environ["A_SECRET_TOKEN"]),
        "read accounts": tried(lambda: read("/etc/passwd")),
        "read scene": tried(lambda: read(PLACES["scene"])),
        "write launch": tried(lambda: write(os.path.join(FOLDER, "note"))),
        "network": tried(lambda: reach(PLACES["port"])),
        "processes": seen_processes(),
    }
    outlive(os.path.join(FOLDER, "outlived"))
    with open(os.path.join(FOLDER, "findings.json"), "w") as stream:
        json.dump(findings, stream)
elif CASE == "link":
    os.symlink(PLACES["home"], os.path.join(FOLDER, "a-picture.bin"))
elif CASE == "memory":
    hoard = []
    while True:
        hoard.append(bytearray(os.urandom(1 << 20)) * 16)
