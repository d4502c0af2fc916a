"""An experiment on Slurm: a controller and three nodes on this machine, with tasks and a node killed in the middle.

    slurm_test.py FORAGE_PROGRAM PROJECT_DIRECTORY

Is skipped where munge or Slurm is not installed, and for users other than root.
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
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
        self.start("munged", "munged", "-F", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket", f"--pid-file={folder}/munged.pid",
                   f"--log-file={folder}/munged.log", f"--seed-file={folder}/seed")
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
                process.wait(5)
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


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def said(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def wait_for(condition, seconds=90):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(said("squeue") + "\n" + said("sinfo"))
        time.sleep(0.2)


@unittest.skipUnless(all(map(shutil.which, NEEDED)), "Slurm is not installed: apt-get install slurm-wlm munge")
@unittest.skipUnless(os.geteuid() == 0, "slurmd needs root")
class Slurm(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="forage-slurm-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        cluster = self.folder / "cluster"
        cluster.mkdir()
        self.cluster = Cluster(cluster)
        self.addCleanup(self.cluster.stop)
        (self.folder / "x.xml").write_text(f"""<experiment>
  <system file="{PROJECT}/systems/reactive_foraging.iqr"/>
  <world file="{PROJECT}/systems/worlds/basic_arena.world"/>
  <length trials="60" longest-trial="60"/>
  <seeds first="1" count="60"/>
  <sweep parameter="Reactive Layer/US.threshold" values="0.2 0.8"/>
  <measure name="success" success="all"/>
</experiment>
""")

    def forage(self, *arguments, directory="it's here"):
        return subprocess.run([FORAGE, "experiment", "x.xml", "-o", directory, *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_tasks_and_a_node_are_killed(self):
        results = self.folder / "it's here"
        dry = self.forage("--slurm", "--dry-run", "--partition", "short", "--time", "5:00", "--array-size", "6")
        self.assertEqual(dry.returncode, 0, dry.stderr)
        self.assertIn("#SBATCH --partition=short\n#SBATCH --time=5:00\n", (results / "slurm" / "parts.sh").read_text())
        self.assertEqual(said("squeue", "-h"), "")
        submitted = self.forage("--slurm", "--partition", "short", "--time", "5:00", "--array-size", "6")
        self.assertEqual(submitted.returncode, 0, submitted.stderr)
        self.assertRegex(submitted.stdout, r"Slurm jobs \d+ \(6 parts\) and \d+ \(merge\)")
        parts = results / "parts"
        wait_for(lambda: parts.exists() and len(list(parts.iterdir())) >= 3)
        for node in ("n1", "n2"):  # kills the program, not the script of the task
            for pid in self.cluster.tasks_of(node):
                if command_of(pid).startswith(FORAGE):
                    kill(pid)
        self.cluster.kill_node("n3")
        self.assertRegex(self.forage("--status").stdout, r"\d+/120 runs(.|\n)*Slurm jobs")
        wait_for(lambda: "n3" not in said("squeue", "-h", "-t", "R", "-o", "%N"))
        wait_for(lambda: not said("squeue", "-h"))
        log = (results / "slurm" / "merge.log").read_text()
        self.assertIn("120 runs\n", log)
        self.assertIn("Killed", "".join(p.read_text() for p in (results / "slurm").glob("part-*.log")))
        self.assertGreater(len(list(parts.iterdir())), 6)  # parts that were killed have started again
        self.assertEqual(self.forage(directory="whole").returncode, 0)
        for name in ("results.csv", "summary.csv"):
            self.assertEqual((results / name).read_bytes(), (self.folder / "whole" / name).read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
