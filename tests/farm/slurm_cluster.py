"""A Slurm of two nodes on this machine, with a munge of its own, under one folder; needs root for PID namespaces."""
import os
from pathlib import Path
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo", "unshare", "nsenter")
CONFIGURATION = """ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthInfo=socket={folder}/munge.sock,cred_expire=5
SlurmctldPort={port}
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/controller.pid
SlurmctldLogFile={folder}/controller.log
SlurmdSpoolDir={folder}/spool.%n
SlurmdPidFile={folder}/%n.pid
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,bf_interval=1
MpiDefault=none
ReturnToService=2
KillWait=10
MaxArraySize=3
SlurmdTimeout=10
MessageTimeout=5
MailProg=/bin/true
NodeName=n1 NodeHostname=node1 NodeAddr=127.0.0.1 Port={port1} CPUs=1
NodeName=n2 NodeHostname=node2 NodeAddr=127.0.0.1 Port={port2} CPUs=1
PartitionName=bake Nodes=n1,n2 Default=YES State=UP
"""


def missing_programs():
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    missing = [name for name in PROGRAMS if not shutil.which(name, path=path)]
    return missing if os.geteuid() == 0 else [*missing, "root"]


def three_free_ports():
    sockets = [socket.socket() for _ in range(3)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rnm-slurm-"))  # short: a socket's path has 107 bytes
        self.processes = []

    def environment(self, others=os.environ):
        return {**others, "SLURM_CONF": str(self.folder / "slurm.conf"),
                "PATH": others.get("PATH", "") + ":/usr/sbin:/sbin"}

    def start(self):
        port, port1, port2 = three_free_ports()
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=self.folder, host=socket.gethostname().split(".")[0], port=port, port1=port1, port2=port2))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.begin("munged", "-F", "-f", f"--key-file={key}", f"--socket={self.folder}/munge.sock",
                   f"--pid-file={self.folder}/munge.pid", f"--log-file={self.folder}/munge.log",
                   f"--seed-file={self.folder}/munge.seed")
        self.wait(lambda: (self.folder / "munge.sock").exists())
        self.start_controller("-c")
        self.nodes = {}
        for node in ("n1", "n2"):
            (self.folder / f"spool.{node}").mkdir()
            self.start_node(node)
        self.wait(lambda: self.idle() == ["n1", "n2"])

    def start_controller(self, *words):
        self.controller = self.begin("slurmctld", "-D", *words, "-f", str(self.folder / "slurm.conf"))

    def kill_controller(self):
        """Without a chance to save anything."""
        self.end(self.controller, signal.SIGKILL)

    def start_node(self, node):
        """In a PID namespace of its own: whatever runs on a node ends with it."""
        self.nodes[node] = self.begin("unshare", "--pid", "--fork", "--mount-proc", "--kill-child=KILL", "bash", "-c",
                                      'slurmd -D -c -N "$1" -f "$2" & wait $!', "init", node,
                                      str(self.folder / "slurm.conf"))

    def kill_node(self, node):
        """As if its power had gone."""
        self.end(self.nodes.pop(node), signal.SIGKILL)

    def hide(self, node, folder):
        """From then on the node has an empty folder of its own there."""
        self.on_node(node, "mount", "-t", "tmpfs", "none", folder)

    def show(self, node, folder):
        self.on_node(node, "umount", folder)

    def on_node(self, node, *words):
        subprocess.run(["nsenter", "-t", str(self.nodes[node].pid), "-m", *map(str, words)], check=True, timeout=60)

    def begin(self, *words):
        with open(self.folder / f"{words[0]}-{len(self.processes)}.out", "wb") as out:
            self.processes.append(subprocess.Popen(words, env=self.environment(), stdin=subprocess.DEVNULL, stdout=out,
                                                   stderr=out, start_new_session=True))
        return self.processes[-1]

    def end(self, process, with_signal):
        self.processes.remove(process)
        process.send_signal(with_signal)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def idle(self):
        done = subprocess.run(["sinfo", "-h", "-N", "-t", "idle", "-o", "%N"], env=self.environment(), capture_output=True,
                              encoding="utf-8", timeout=60)
        return sorted(done.stdout.split())

    def wait(self, what):
        limit = time.time() + 60
        while not what():
            if time.time() > limit:
                said = [file.read_text(errors="replace")[-500:] for file in self.folder.glob("*.out")]
                raise AssertionError(f"Slurm does not start: {said}")
            time.sleep(0.1)

    def stop(self):
        for process in reversed(list(self.processes)):
            self.end(process, signal.SIGTERM if "unshare" not in process.args else signal.SIGKILL)
        shutil.rmtree(self.folder, ignore_errors=True)
