"""What the tests of runs on LinuxCNC do at the desk: start the program under test, wait for what it does, disturb it."""

import os
import signal
import subprocess

from desk import *

PROGRAM = "probewright"  # its path, which the test sets


def hal(pin, value):
    subprocess.run(["halcmd", "setp", pin, str(value)], check=True)


def look(pin):
    return subprocess.run(["halcmd", "-s", "getp", pin], check=True, capture_output=True, text=True).stdout.strip()


def world(x, y, radius, top):
    """Where the bore is, the distance at which the ball touches its wall, and the height at which the tip does."""
    for pin, value in (("dx.in1", -x), ("dy.in1", -y), ("outside.in0", radius), ("below.in1", top)):
        hal(pin, value)


def start(program, out="out", setup="setup.toml", machine="linuxcnc", more=(), path=""):
    words = [PROGRAM, "run", program, "--setup", setup, "--out", out, "--quiet", "--machine", machine, *more]
    environment = dict(os.environ, PATH=path + os.environ["PATH"])
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment)


def ended(desk, name, run, seconds=300):
    """Waits for the end of a run and tells its exit code and its mistakes: `desk: NAME CODE TEXT`."""
    try:
        errors = run.communicate(timeout=seconds)[1]
    except subprocess.TimeoutExpired:
        run.kill()
        desk.tell(name, "does not end")
        return
    desk.tell(name, run.returncode, " | ".join(errors.split("\n")))


def probing(desk):
    desk.until("a measuring move", lambda s: s.motion_type == 5 and s.current_vel > 0)


def moving(desk):
    """Waits for a move, and until it is well under way."""
    desk.until("a move", lambda s: s.current_vel > 0)
    begin = list(desk.status.position[:3])
    desk.until("way", lambda s: max(abs(a - b) for a, b in zip(s.position, begin)) > 1)


def still(desk):
    desk.until("the axes to stand", lambda s: s.inpos and s.current_vel == 0)
    desk.settle()


def adapter():
    """The process of the machine adapter."""
    found = subprocess.run(["pgrep", "-f", "/probewright-linuxcnc$"], capture_output=True, text=True).stdout.split()
    return int(found[0])


def engine():
    """The process of probewright that LinuxCNC's planner has started."""
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/stat") as file:
                number, name, rest = file.read().replace("(", "|").replace(")", "|").split("|")
            with open(f"/proc/{rest.split()[1]}/comm") as file:
                if name == "probewright" and file.read().strip() == "milltask":
                    return int(number)
        except OSError:
            pass
    raise RuntimeError("no engine runs")
