"""What tests do at a real LinuxCNC: a display without a screen. LinuxCNC starts the test's script as its [DISPLAY]; that
uses Desk, and whatever it prints is read by the test. When the script ends, LinuxCNC ends."""

import os
import sys
import time
import traceback

import linuxcnc


def failed(*what):
    """A script that fails ends as others do: of a display that ends with an error LinuxCNC tells in a window of its own, and
    waits until somebody closes it."""
    traceback.print_exception(*what)
    sys.stderr.flush()
    os._exit(0)


sys.excepthook = failed


class Desk:
    def __init__(self):
        self.command = linuxcnc.command()
        self.status = linuxcnc.stat()
        self.errors = linuxcnc.error_channel()
        self.messages = []
        self.status.poll()

    def tell(self, *words):
        print("desk:", *words, flush=True)

    def listen(self):
        while True:
            message = self.errors.poll()
            if not message:
                return
            self.messages.append(message[1])
            self.tell("message", message[1].replace("\n", " "))

    def until(self, what, condition, seconds=120.0):
        """Waits for a condition of the status; says so and ends the session if it does not come. The time is for a
        computer that has ten times more to do than it can."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.status.poll()
            self.listen()
            if condition(self.status):
                return
            time.sleep(0.004)
        self.tell("waited in vain for", what)
        sys.exit()

    def taken(self):
        """Waits until LinuxCNC has begun what the last command orders: its status then tells of it."""
        self.until("LinuxCNC to take a command", lambda s: s.echo_serial_number >= self.command.serial)

    def mode(self, mode):
        self.command.mode(mode)
        self.taken()
        self.until("the mode", lambda s: s.task_mode == mode)

    def begin(self, program, line=0):
        """Opens a program and starts it."""
        self.mode(linuxcnc.MODE_AUTO)
        self.command.program_open(program)
        self.taken()
        self.command.auto(linuxcnc.AUTO_RUN, line)
        self.taken()

    def switch_on(self):
        self.command.state(linuxcnc.STATE_ESTOP_RESET)
        self.until("the end of the emergency stop", lambda s: s.task_state != linuxcnc.STATE_ESTOP)
        end = time.monotonic() + 120
        while self.status.task_state != linuxcnc.STATE_ON:
            self.command.state(linuxcnc.STATE_ON)
            self.command.wait_complete(1)
            time.sleep(0.05)
            self.status.poll()
            if time.monotonic() > end:
                self.tell("the machine cannot be switched on")
                sys.exit()
        self.listen()

    def home(self):
        self.mode(linuxcnc.MODE_MANUAL)
        self.command.teleop_enable(0)
        self.taken()
        self.until("the joints", lambda s: s.motion_mode == linuxcnc.TRAJ_MODE_FREE)
        self.command.home(-1)
        self.until("homing", lambda s: all(s.homed[: s.joints]))

    def ready(self):
        self.switch_on()
        self.home()

    def run(self, program, seconds=300.0):
        """Runs a program to its end, however that comes."""
        self.begin(program)
        self.until("the end of " + program, lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos, seconds)
        self.settle()

    def mdi(self, block, seconds=30.0):
        self.command.mode(linuxcnc.MODE_MDI)
        self.command.wait_complete()
        self.command.mdi(block)
        self.command.wait_complete(seconds)
        self.until(block, lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos, seconds)
        self.settle()

    def settle(self):
        """Waits until the joints stand: they follow the path by a few cycles and move on after it has ended."""
        before = None

        def stand(status):
            nonlocal before
            now = [*status.joint_position, *status.joint_actual_position, *status.position]
            stood, before = now == before, now
            return stood

        time.sleep(0.05)  # more than the joints follow behind, so that they have begun
        for _ in range(3):
            self.until("the joints to stand", stand)
