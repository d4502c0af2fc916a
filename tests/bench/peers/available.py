"""Which peers are installed, and what to install for those that are not."""
import os
import subprocess
import sys

INSTALL = {
    "NumPy": "apt install python3-numpy libopenblas0-pthread",
    "SciPy": "apt install python3-scipy",
    "Brian2": "apt install python3-brian python3-brian-lib cython3 g++ make",
    "Bullet": "apt install libbullet-dev, and build again",
    "MuJoCo": "apt install libmujoco-dev (Debian 12), and build again",
    "Enki": "apt install libenki-dev (Debian 12), and build again",
}


def use_python_with_numpy():
    """Restarts the script with the distribution's Python if this one has no NumPy. Ends it with status 77 if neither has."""
    try:
        import numpy  # noqa: F401
    except ImportError:
        if sys.executable == "/usr/bin/python3" or not os.path.exists("/usr/bin/python3"):
            print("skipped: apt install python3-numpy")
            sys.exit(77)
        os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B", *sys.argv])


def imports(code):
    return subprocess.run([sys.executable, "-W", "ignore", "-c", code], capture_output=True).returncode == 0


def peers(programs):
    """The names of the installed peers; tells of the others. `programs` is the folder of the programs that CMake built."""
    found = {"Bullet": (programs / "peer_bullet_robots").exists(), "MuJoCo": (programs / "peer_mujoco_robots").exists(),
             "Enki": (programs / "peer_enki_robots").exists(), "NumPy": imports("import numpy"),
             "SciPy": imports("import scipy.sparse"), "Brian2": imports("import brian2")}
    for name, installed in found.items():
        if not installed:
            print(f"{name} is skipped: {INSTALL[name]}")
    if found["NumPy"] and not imports("import numpy.linalg; assert 'openblas' in open('/proc/self/maps').read()"):
        print("NumPy runs without OpenBLAS, which is slower: " + INSTALL["NumPy"])
    return {name for name, installed in found.items() if installed}
