#!/usr/bin/python3
"""A display without a screen: switches the machine on, homes it, runs one program and prints what LinuxCNC says."""

import sys
import time

import linuxcnc


def main():
    program = next(word for word in sys.argv[1:] if not word.startswith("-") and not word.endswith(".ini"))
    command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()

    def until(what, condition, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            message = errors.poll()
            if message:
                print(message[1], flush=True)
            status.poll()
            if condition():
                return
            time.sleep(0.005)
        sys.exit("waited in vain for " + what)

    command.state(linuxcnc.STATE_ESTOP_RESET)

    def is_on():
        # The part is read meanwhile; until the probe feels it the machine stays off.
        command.state(linuxcnc.STATE_ON)
        command.wait_complete(1)
        status.poll()
        return status.task_state == linuxcnc.STATE_ON

    until("the machine to be switched on", is_on, 120)

    def told(order, *words):
        order(*words)
        until("LinuxCNC to take a command", lambda: status.echo_serial_number >= command.serial, 60)

    told(command.mode, linuxcnc.MODE_MANUAL)
    told(command.teleop_enable, 0)
    until("the joints", lambda: status.motion_mode == linuxcnc.TRAJ_MODE_FREE, 60)
    told(command.home, -1)
    until("homing", lambda: all(status.homed[: status.joints]), 60)
    told(command.mode, linuxcnc.MODE_AUTO)
    told(command.program_open, program)
    told(command.auto, linuxcnc.AUTO_RUN, 0)
    until("the end of the program", lambda: status.interp_state == linuxcnc.INTERP_IDLE and status.inpos, 3600)
    # What LinuxCNC prints comes a moment later.
    time.sleep(0.5)
    until("nothing", lambda: True, 1)


main()
