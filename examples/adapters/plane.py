#!/usr/bin/env python3
"""A machine adapter for Probewright, to read and to change: it plays a mill with three axes on which nothing moves.

The protocol (docs/machine-adapters.md) is one JSON object a line, on standard input and output:
    probewright run PROGRAM --setup SETUP --machine examples/adapters/plane.py
Tool 1 is a touch probe whose ball meets a plane when the spindle nose stands at Z-300. Tool 2 is a cutter that touches
the tool touch probe at X24, as long as it is lower than Z-260. The magazine holds nothing else.
"""
import json
import math
import select
import sys

AXES = [("X", -500, 500), ("Y", -300, 300), ("Z", -600, 10)]
PLANE, CONTACT = -300.0, 24.0  # where the probe and the tool touch probe signal
at, tool, clock, tool_change = [0.0, 0.0, 0.0], 0, 0.0, [0.0, 0.0, 0.0]
spindle = {"rotation": "none", "speed": 0, "angle": 0}


def readline():
    return json.loads(line) if (line := sys.stdin.readline()) else None


def stop_asked(order):
    """Whether the engine has asked for a stop of this order. A machine that moves asks again and again on its way."""
    while select.select([sys.stdin], [], [], 0)[0]:
        line = readline()
        if line is None or line.get("order") == order["id"]:
            return True
    return False


def deflected(sensor, place):
    if sensor == "touchProbe":
        return tool == 1 and place[2] <= PLANE
    return tool == 2 and place[0] >= CONTACT and place[2] < -260


def contact(target):
    """The part of the way at which a sensor signals or the cutter meets the plane, and what does."""
    axis, surface, what = (2, PLANE, "touchProbe") if tool == 1 else (0, CONTACT, "toolTouchProbe")
    if tool == 2 and target[2] < PLANE < at[2]:
        return (PLANE - at[2]) / (target[2] - at[2]), "collision"
    if not deflected(what, at) and deflected(what, target):
        return (surface - at[axis]) / (target[axis] - at[axis]), what
    return 1.0, None


def travel(target, order, fraction):
    global at, clock
    goal = list(target) if fraction == 1 else [a + fraction * (t - a) for a, t in zip(at, target)]
    clock += math.dist(at, goal) / (20000 if order.get("rapid") else order["feed"]) * 60
    at = goal


def line(order, target, leaves=False, measures=None):
    """A straight line; how it ends is the answer."""
    for (name, low, high), value in zip(AXES, target):
        if not low <= value <= high:
            return {"end": "axisLimit", "detail": f"software limit of {name}"}
    if not leaves and measures is None and any(deflected(s, at) for s in ("touchProbe", "toolTouchProbe")):
        return {"end": "probeSignal", "detail": "the sensor is still deflected"}
    if stop_asked(order):
        return {"end": "cancelled"}
    fraction, what = (1.0, None) if leaves else contact(target)
    travel(target, order, fraction)
    if what is None:
        return {"end": "noContact" if measures else "reached"}
    if what != "collision" and what == measures:
        return {"end": "touched", "latched": at}
    return {"end": "collision" if what == "collision" else "probeSignal", "detail": "something is in the way"}


def path(order):
    for reached, piece in enumerate(order["pieces"]):
        answer = line({**order, **piece}, piece["target"])
        if answer["end"] != "reached":
            return {**answer, "reached": reached}
    return {"end": "reached", "reached": len(order["pieces"])}


def measure(order):
    if tool != {"touchProbe": 1, "toolTouchProbe": 2}[order["sensor"]]:
        return {"end": "notReady", "detail": "the sensor cannot signal with this tool"}
    if deflected(order["sensor"], at):
        return {"end": "deflectedAtStart", "detail": "the sensor is deflected"}
    return line(order, order["target"], measures=order["sensor"])


def change_tool(order):
    global at, tool, clock
    if order["number"] == tool:
        return {"end": "changed"}
    if order["number"] not in (0, 1, 2):
        return {"end": "missing", "detail": f"no pocket holds tool {order['number']}"}
    if deflected("touchProbe", at) or deflected("toolTouchProbe", at):
        return {"end": "probeSignal", "detail": "a sensor is deflected"}
    at, tool, clock = list(tool_change), order["number"], clock + 6
    spindle.update(rotation="none", speed=0)
    return {"end": "changed"}


def carry_out(order):
    global clock
    match order["do"]:
        case "hello":
            axes = [{"name": n, "kind": "linear", "minimum": low, "maximum": high} for n, low, high in AXES]
            machine = {"name": "plane", "axes": axes, "toolChange": tool_change, "spindleOrients": True}
            return {"protocol": 1, "adapter": "example", "machine": machine, "functions": [7, 8, 9]}
        case "move":
            return line(order, order["target"])
        case "retract":
            return line(order, order["target"], leaves=True)
        case "path":
            return path(order)
        case "measure":
            return measure(order)
        case "deflected":
            return {"deflected": deflected(order["sensor"], at)}
        case "probeSerial":
            return {"serial": "4711" if tool == 1 else ""}
        case "turnSpindle":
            spindle.update(rotation=order["rotation"], speed=order["speed"])
            return {"end": "reached"}
        case "orientSpindle":
            spindle.update(rotation="none", speed=0, angle=order["degrees"])
            return {"end": "reached"}
        case "spindle":
            return dict(spindle)
        case "function":
            return {"end": "carriedOut"}
        case "changeTool":
            return change_tool(order)
        case "dwell":
            clock += order["seconds"]
            return {"end": "over"}
        case "seconds":
            return {"seconds": clock}
    return {}  # "position": every answer tells it


while (order := readline()) is not None:
    if order["do"] != "stop":  # one that comes after its order has ended
        print(json.dumps({"id": order["id"], **carry_out(order), "position": at}), flush=True)
