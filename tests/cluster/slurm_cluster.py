"""A Slurm cluster of a controller and three nodes, as processes of a test on this machine."""
import os
import pathlib
import shutil
import socket
import subprocess
import time

from support import kill

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
os.environ["PATH"] += ":/usr/sbin"

CONFIGURATION = """ClusterName=forage
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CommunicationParameters=NoInAddrAny
SlurmctldPort={port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdTimeout=3
KillWait=1
{nodes}
PartitionName=short Nodes=n1,n2,n3 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Cluster:
    """munged, slurmctld and three slurmd, as processes of this test."""

    def __init__(self, folder):
        self.folder, self.processes = folder, {}
        host = socket.gethostname().split(".")[0]
        ports = free_ports(4)
        nodes = "\n".join(f"NodeName=n{i} NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[i]} CPUs=1" for i in (1, 2, 3))
        (folder / "slurm.conf").write_text(CONFIGURATION.format(host=host, folder=folder, port=ports[0], nodes=nodes))
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        key = folder / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        for name in ("state", "spool.n1", "spool.n2", "spool.n3"):
            (folder / name).mkdir()
        self.start(
            "munged",
            "munged",
            "-F",
            "--force",
            f"--key-file={key}",
            f"--socket={folder}/munge.socket",
            f"--pid-file={folder}/munged.pid",
            f"--log-file={folder}/munged.log",
            f"--seed-file={folder}/seed",
        )
        wait_for((folder / "munge.socket").exists)
        self.start("slurmctld", "slurmctld", "-D", "-c")
        for node in ("n1", "n2", "n3"):
            self.start(node, "slurmd", "-D", "-N", node)
        wait_for(lambda: said("sinfo", "-h", "-o", "%T %D") == "idle 3")

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "a") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)

    def tasks_of(self, node):
        """The processes of the tasks that run on a node, by its name in their environment."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                variables = (entry / "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            if entry.name.isdigit() and f"SLURMD_NODENAME={node}".encode() in variables and f"SLURM_CONF={os.environ['SLURM_CONF']}".encode() in variables:
                found.append(int(entry.name))
        return found

    def kill_node(self, node):
        """Kills the daemon, the shepherds of its tasks and the tasks, as a power cut does."""
        daemon = self.processes.pop(node)
        daemon.kill()
        daemon.wait()
        tasks = self.tasks_of(node)
        parents = {parent_of(pid) for pid in tasks}
        for pid in [p for p in parents if "slurmstepd" in command_of(p)] + tasks:
            kill(pid)

    def stop(self):
        for node in ("n1", "n2", "n3"):
            for pid in self.tasks_of(node):
                kill(pid)
        for process in reversed(list(self.processes.values())):
            process.terminate()
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def command_of(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_text(errors="replace").replace("\0", " ")
    except OSError:
        return ""


def parent_of(pid):
    try:
        return int(pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return 0


def said(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def wait_for(condition, seconds=900):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(said("squeue") + "\n" + said("sinfo"))
        time.sleep(0.2)


def why_not():
    """Why there can be no cluster; empty when there can be one."""
    if not all(map(shutil.which, NEEDED)):
        return "Slurm is not installed: apt-get install slurm-wlm munge"
    return "" if os.geteuid() == 0 else "slurmd needs root"
