"""Programs that measure tools, rotary axes and the working space in random worlds, for random_programs.py: a 5-axis machine with a tool
touch probe and a calibration sphere on its table, tools whose teeth run out, rotary axes beside the drawing, and a camera.
"""

import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROBE = (-150, -110, -500)  # where the tool touch probe was meant to be fitted
# The machine, its axis that tilts, and where the sphere was meant to be.
MACHINES = (("mill5-table-table", "A", (120, 40, -480)), ("mill5-head-table", "B", (130, 100, -540)))


class World:
    def __init__(self, dice, control):
        self.dice, self.control = dice, control
        self.machine, self.tilting, self.sphere = dice.choice(MACHINES)
        self.radius = dice.choice((10, 12.5))
        self.teeth = dice.randint(2, 4)
        self.edge = dice.randint(5, 9)  # of the mill, mm
        self.length = dice.randint(70, 95)
        self.contact = dice.choice((20, 24, 30))

    def setup(self):
        dice = self.dice
        some = lambda reach: round(dice.uniform(-reach, reach), 4)
        away = lambda place, reach: "{ " + ", ".join(f"{axis} = {value + some(reach):.4f}" for axis, value in zip("xyz", place)) + " }"
        lines = [f"seed = {dice.randint(1, 99999)}", "[machine]", f'name = "{self.machine}"', "[control]", f'type = "{self.control}"']
        for axis in (self.tilting, "C"):
            lines += [f"[errors.rotary.{axis}]", f"position = {[some(0.05) for _ in range(3)]}",
                      f"orientation = {[some(0.004) for _ in range(3)]}"]
        lines += ["[tool_probe]", f"diameter = {self.contact}", "thickness = 10", "stem_diameter = 6", f"pose = {away(PROBE, 0.4)}",
                  f"pretravel = {abs(some(0.004))}", f"repeatability = {abs(some(0.0004))}"]
        lines += ["[sphere]", f"diameter = {2 * self.radius}", "stem_diameter = 6", "stem_length = 60", f"pose = {away(self.sphere, 0.2)}"]
        lines += ["[[tool]]", "number = 1", 'name = "TS"', 'kind = "probe"', "length = 150", "ball_radius = 2", "stylus_radius = 1",
                  "stylus_length = 60", "body_radius = 20", f"pretravel = {abs(some(0.006))}", f"repeatability = {abs(some(0.0003))}",
                  "maximum_travel = 20"]
        lines += ["[[tool]]", "number = 9", 'name = "PIN"', 'kind = "mill"', "length = 75", "radius = 6", "[tool.cutter]",
                  "cutting_length = 40", f"eccentricity = [{some(0.01)}, {some(0.01)}]", 'cutting_direction = "none"']
        lines += ["[[tool]]", "number = 12", 'name = "MILL"', 'kind = "mill"', f"length = {self.length + some(0.3)}",
                  f"radius = {self.edge + some(0.1)}", f"believed_length = {self.length}", f"believed_radius = {self.edge}", "[tool.cutter]",
                  f"teeth = {self.teeth}", f"first_tooth = {dice.randint(-90, 90)}", f"helix = {dice.choice((0, 20, 30))}",
                  "cutting_length = 30"]
        for tooth in range(1, self.teeth + 1):
            lines += ["[[tool.cutter.tooth]]", f"number = {tooth}", f"radial = {some(0.01)}", f"axial = {some(0.01)}"]
            if dice.random() < 0.15:
                lines += [f"broken = {abs(some(0.5))}"]
        x, y, z = self.sphere
        if self.control in ("TNC640", "iTNC530"):
            lines += ["[[preset]]", "row = 1", f"origin = [{x + some(0.4)}, {y + some(0.4)}, {z + some(0.4)}]", "active = true"]
        else:
            lines += ["[[zero_offset]]", 'name = "G56"', f"origin = [{float(x)}, {float(y)}, {z + self.radius}]", "active = true"]
        if self.control == "TNC640" and dice.random() < 0.5:
            lines += ["[camera]", "position = [0, -130, -20]", "direction = [0, 0.25, -1]", "resolution = [160, 120]", "field_of_view = 45",
                      "[[camera.lamp]]", "position = [-350, -250, 150]", "brightness = 0.5"]
        self.camera = "[camera]" in lines
        return "\n".join(lines) + "\n"


def klartext(world):
    """Calibrate, measure a tool, look, measure the axes, measure in a tilted plane."""
    dice = world.dice
    lines, number = ["0 BEGIN PGM RANDOM MM"], 1

    def block(text):
        nonlocal number
        lines.append(f"{number} {text}")
        number += 1

    def cycle(number_, name, **words):
        block(f"TCH PROBE {number_} {name} ~\n" + " ~\n".join(f"  {key}={value} ;VALUE" for key, value in words.items()))

    old = dice.random() < 0.4
    block("TOOL CALL 9 Z")
    if old:
        block("TCH PROBE 30.0 CALIBRATE TT")
        block("TCH PROBE 30.1 HEIGHT: +120")
    else:
        cycle(480, "CALIBRATE TT", Q260="+120")
    block("TOOL CALL 12 Z")
    for kind in dice.sample((1, 2, 3), 2):
        mode = dice.choice((0, 1) if old or world.control == "iTNC530" else (0, 1, 2))
        if old:
            name = f"TCH PROBE {30 + kind}"
            for line in (".0 TOOL", f".1 CHECK: {mode} Q5", ".2 HEIGHT: +120", ".3 PROBING THE TEETH: 0"):
                block(name + line)
        else:
            cycle(480 + kind, "TOOL", Q340=f"+{mode}", Q260="+120", Q341="+0")
    if world.camera:
        cycle(601, "LOCAL WORKING SPACE", QS600='"PLACE"', Q309="+0", Q613="+0", Q617="+3")
    block("TOOL CALL 1 Z")
    newer = world.control == "TNC640"
    cycle(450, "SAVE KINEMATICS", Q410="+0", **({"QS409": '"BEFORE"'} if newer else {"Q409": "+3"}))
    block("L Z+120 R0 FMAX")
    block("L X+0 Y+0 R0 FMAX")
    block(f"L Z+{world.radius + 4} R0 F2000")
    # The older control refuses a measuring point at 0.
    points, span = dice.choice((3, 4, 5) if newer else (4, 6)), dice.choice((60, 75))
    axes = {}
    for first, axis in ((411, "A"), (415, "B"), (419, "C")):
        if axis == "C":
            values = (90, 270, 0, 3)
        else:
            values = (-span, span, 0, points) if axis == world.tilting else (0, 0, 0, 0)
        axes.update({f"Q{first + i}": f"{value:+}" for i, value in enumerate(values)})
    common = {"Q407": f"+{world.radius}", "Q320": "+0", "Q408": dice.choice(("+0", "+0", "+150")), "Q253": "+5000", "Q380": "+45", **axes,
              "Q423": "+4"}
    cycle(451, "MEASURE KINEMATICS", Q406=f"+{dice.choice((0, 1, 1, 2))}", **common, Q431="+3", Q432="+0")
    block("PLANE RESET STAY")
    block("L Z+150 R0 FMAX")
    if dice.random() < 0.4:
        block(f"L {world.tilting}+0 C+0 R0 FMAX")
        cycle(452, "PRESET COMPENSATION", **common, Q432="+0")
        block("PLANE RESET STAY")
        block("L Z+150 R0 FMAX")
    block(f"PLANE SPATIAL SPA+{dice.randint(0, 25)} SPB+{dice.randint(0, 25)} SPC+0 TURN FMAX")
    block(f"L Z+{world.radius + 50} R0 FMAX")
    block("L X+0 Y+0 R0 FMAX")
    cycle(427, "MEASURE COORDINATE", Q263="+0", Q264="+0", Q261=f"+{world.radius}", Q320="+0", Q272="+3", Q267="-1", Q260="+50",
          Q281="+0", Q288=f"+{world.radius + 0.01:.3f}", Q289=f"+{world.radius - 0.01:.3f}", Q309="+0", Q330="+0")
    if dice.random() < 0.3:
        cycle(450, "SAVE KINEMATICS", Q410="+1", **({"QS409": '"BEFORE"'} if newer else {"Q409": "+3"}))
    block("END PGM RANDOM MM")
    return "\n".join(lines) + "\n"


def sinumerik(world):
    """The same; the rotary axes as the example of the kinematics measures them."""
    dice = world.dice
    x, y, z = PROBE
    rows = world.contact / 2
    lines = ["G17 G90 G71 G500"]
    for axis, middle in ((1, x), (2, y)):
        lines += [f"$SNS_MEA_TP_TRIG_MINUS_DIR_AX{axis}[0]={middle + rows} $SNS_MEA_TP_TRIG_PLUS_DIR_AX{axis}[0]={middle - rows}"]
    lines += [f"$SNS_MEA_TP_TRIG_MINUS_DIR_AX3[0]={z}", 'T="PIN" D1 M6', f"G0 X{x} Y{y}", f"G0 Z{z + 30}",
              f"CYCLE971({dice.choice((0, 100000, 1100000))},,1,{dice.choice((1, 2, 3))},,,5,2)" if dice.random() < 0.3 else
              f"CYCLE971({dice.choice((100000, 1100000))},,1,,,,5,2)",
              f"G0 Z{z + 60}", 'T="MILL" D1 M6', f"G0 X{x - 35} Y{y}", f"G0 Z{z + 30}"]
    for axis in dice.sample((1, 103), 2):
        way = dice.choice((1, 2, 2, 102))
        lines += [f"CYCLE971({way},{dice.choice((0, 1))},1,{axis},,,5,{8 if way == 1 else 2},,0.001,9)", f"G0 Z{z + 30}", f"G0 X{x - 35} Y{y}"]
    lines += [f"R1=_OVR[8] R2=_OVR[10]", f"G0 Z{z + 150}"]
    text = (ROOT / "examples/programs/kinematics.mpf").read_text()
    text = text.replace("BALL=25", f"BALL={2 * world.radius}").replace("3D-PROBE", "TS").replace("N540 IF OFF[1]>0.005", "N540 IF OFF[1]>5")
    if world.tilting == "A":
        text = text.replace("AT_B", "AT_A").replace("B=AT_A", "A=AT_A").replace("G0 B0", "G0 A0").replace("MIXED_BC", "TABLE_AC")
        text = text.replace("13201000", "13101000")
    first = next(line for line in text.splitlines() if line.startswith("N10 "))
    # Declarations come first.
    return text.replace(first, first + "\n" + "\n".join(lines), 1)


def case(dice, control):
    """Setup, name and text of a program."""
    world = World(dice, control)
    setup = world.setup()
    if control in ("TNC640", "iTNC530"):
        return setup, "random.h", klartext(world)
    return setup, "random.mpf", sinumerik(world)
