"""SINUMERIK programs that measure shafts and tools on a lathe, for random_programs.py."""

from random_sinumerik_programs import call


def turned(dice):
    """A shaft in the chuck of a lathe, measured by the turning cycles."""
    large, small = dice.randint(45, 70), dice.randint(25, 40)
    true = lambda size: round(size + dice.uniform(-0.06, 0.06), 4)
    setup = f"""seed = {dice.randint(1, 99999)}
[machine]
name = "lathe2c"
[control]
type = "840Dsl"
[part]
pose = {{ x = {dice.uniform(-0.03, 0.03):.4f}, z = {dice.uniform(-0.3, 0.3):.4f} }}
[[part.feature]]
shape = "cylinder"
diameter = {true(large)}
height = 120
[[part.feature]]
shape = "cylinder"
centre = [0, 0, 120]
diameter = {true(small)}
height = 60
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 120
ball_radius = {dice.choice((2, 3))}.0
stylus_length = 60
body_radius = 20
shank_direction = [0, 0, 1]
pretravel = {dice.uniform(0, 0.008):.4f}
repeatability = {dice.uniform(0, 0.0004):.5f}
[[tool]]
number = 3
name = "FINISH"
kind = "turn"
length = 60
radius = 0.4
shank_direction = [1, 0, 0]
[[zero_offset]]
name = "G54"
origin = [0, 0, 180]
active = true
"""
    correct = dict(KNUM1=100001, TNAME="FINISH", TZL=0.002, TDIF=0.5, TUL=0.03, TLL=-0.03, TMV=0.3, K=1, _AMODE=1)
    text = 'G54 G18 G90 G95 DIAMON\nT="PROBE" D1\nG0 X140 Z50\n'
    text += f"G0 X{small // 2} Z8\n" + call(974, MVAR=dice.choice((0, 100)), KNUM=10001, PRNUM=1, SETV=0, MA=1, FA=8, TSA=2, NMSP=1) + "G0 Z20\n"
    task = dice.choice((0, 200))
    reversal = dice.choice((0, 10000))
    text += f"G0 X{small + 16}\nZ-30\n" + call(974, MVAR=2 + task + reversal, PRNUM=1, SETV=small, MA=2, FA=8, TSA=1, STA1=0, NMSP=1,
                                               **(correct if task else {}))
    text += "G0 Z-12\n" + call(994, MVAR=2, PRNUM=1, SETV=small, MA=102, SZO=20, FA=8, TSA=1, NMSP=dice.choice((1, 2)), TNAME="")
    setup, tools = measured_tools(dice, setup)
    return setup, text + "G0 Z50\nX120\n" + tools + "M30\n"


def measured_tools(dice, setup):
    """A tool touch probe on the bed of a lathe, and the finishing tool and a mill that are measured with it."""
    wrong = lambda: round(dice.uniform(-0.2, 0.2), 4)
    x, z = 120, 520  # beside the way of the probe
    setup += f"""[tool_probe]
size = [20, 20]
thickness = 20
stem_diameter = 6
pose = {{ x = {x + wrong()}, y = 10, z = {z + wrong()}, a = -90 }}
pretravel = {dice.uniform(0, 0.008):.4f}
repeatability = {dice.uniform(0, 0.0004):.5f}
[[tool]]
number = 9
name = "PIN"
kind = "calibration"
length = 70
radius = {dice.randint(3, 6)}
shank_direction = [0, 1, 0]
mount = [-65, 63, -25]
[[tool]]
number = 7
name = "SLOT"
kind = "mill"
length = {45 + wrong()}
radius = {6 + wrong()}
shank_direction = [0, 0, 1]
mount = [-60, 0, -40]
believed_length = 45
believed_radius = 6
"""
    common = dict(PRNUM=1, FA=6, TSA=2, NMSP=dice.choice((1, 2)))
    text = "G500 DIAMOF G94\n"
    for tool, ways in (("PIN", (0,)), ("FINISH", (1, 2)), ("SLOT", (1, 2002, 2001))):
        way = dice.choice(ways)
        text += f'T="{tool}" D1\nG0 Z{z + 60}\nG0 X{x + 45}\n'
        words = dict(common) if way == 0 else dict(common, KNUM=dice.choice((0, 1)), TZL=0.001, TDIF=1)
        if way not in (2, 2002):
            words["MA"] = 2 if way == 2001 else dice.choice((1, 2))
        text += call(982, MVAR=way, **words)
        if tool == "PIN":
            text += f"G0 Z{z + 60}\nG0 X{x + 45}\n" + call(982, MVAR=0, **dict(words, MA=3 - words["MA"]))
        text += f"G0 Z{z + 60}\n"
    return setup, text
