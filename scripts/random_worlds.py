"""A plate with features at places that programs know to a millimetre, on a random machine with random errors, for random_programs.py.

The plate's frame is the program's: X along the long side, Z0 the top face, so each cycle can be called without knowing the others.
"""

import math

PLATE = (240, 160, 40)
HOLE, POCKET, BOLTS = (40, 40), (100, 40), (180, 45)
STUD, BLOCK, SLOT = (40, 115), (100, 115), (170, 115)
STUD2 = (215, 140)  # always 12 mm
RING, BALL = (-80, 80), (285, 80, -5)
HEIGHT = 15  # of stud and block
CLEAR = 45  # nothing stands that high
MILLS = ("mill3", "mill3", "mill5-table-table", "mill5-head-table", "mill5-head-head")


class World:
    def __init__(self, dice, machine):
        self.dice, self.machine = dice, machine
        near = lambda nominal: (nominal, round(nominal + dice.uniform(-0.05, 0.05), 4))
        whole = lambda low, high: near(dice.randint(low, high))
        self.hole, self.stud = whole(18, 34), whole(12, 30)
        self.pocket = (whole(24, 40), whole(20, 34))
        self.block = (whole(20, 36), whole(16, 30))
        self.slot, self.bolt = whole(12, 18), whole(10, 13)
        self.bolts, self.first_bolt = near(dice.randint(34, 46)), dice.randint(0, 80)
        self.ring = round(dice.uniform(32, 50), 3)
        self.ball = dice.choice((20, 25, 30))
        self.probe_radius = dice.choice((1.5, 2, 3))

    def bolt_centre(self, index, true=False):
        angle = math.radians(self.first_bolt + 90 * index)
        radius = self.bolts[true] / 2
        return (BOLTS[0] + radius * math.cos(angle), BOLTS[1] + radius * math.sin(angle))

    def setup(self, control):
        dice = self.dice
        some = lambda reach: round(dice.uniform(-reach, reach), 4)
        tilt = 0.1 if dice.random() < 0.4 else 0
        origin = (-115, -80, -430)
        pose = [origin[i] + some(0.6) for i in range(3)]
        lines = [f"seed = {dice.randint(1, 99999)}", "[machine]", f'name = "{self.machine}"', "[control]", f'type = "{control}"']
        lines += ["[part]", f"pose = {{ x = {pose[0]:.4f}, y = {pose[1]:.4f}, z = {pose[2]:.4f}, "
                  f"a = {some(tilt):.4f}, b = {some(tilt):.4f}, c = {some(0.3):.4f} }}"]

        def feature(shape, centre, **keys):
            lines.extend(["[[part.feature]]", f'shape = "{shape}"', f"centre = {[float(round(c, 6)) for c in centre]}"])
            lines.extend(f"{key} = {value}" for key, value in keys.items())

        feature("box", (PLATE[0] / 2, PLATE[1] / 2, -PLATE[2]), size=[float(side) for side in PLATE])
        feature("cylinder", (*STUD, 0), diameter=self.stud[1], height=float(HEIGHT))
        feature("cylinder", (*STUD2, 0), diameter=12.0, height=float(HEIGHT))
        feature("box", (*BLOCK, 0), size=[self.block[0][1], self.block[1][1], float(HEIGHT)])
        feature("hole", (*HOLE, 0), diameter=self.hole[1])
        feature("pocket", (*POCKET, 0), size=[self.pocket[0][1], self.pocket[1][1]], depth=20.0, corner_radius=2.0)
        feature("slot", (*SLOT, 0), size=[60.0, self.slot[1]], depth=18.0)
        for index in range(4):
            feature("hole", (*self.bolt_centre(index, True), 0), diameter=self.bolt[1], depth=25.0)
        at = lambda place: (f"pose = {{ x = {origin[0] + place[0] + some(0.3):.4f}, y = {origin[1] + place[1] + some(0.3):.4f}, "
                            f"z = {origin[2] + place[2] + some(0.2):.4f} }}")
        lines += ["[ring]", f"diameter = {self.ring}", at((*RING, 0)), "[sphere]", f"diameter = {float(self.ball)}", at(BALL)]
        lines += ["[[tool]]", "number = 1", 'name = "PROBE"', 'kind = "probe"', f"length = {dice.randint(100, 150)}.25",
                  f"ball_radius = {float(self.probe_radius)}", "stylus_length = 40.0", "body_radius = 15.0", "maximum_travel = 12.0"]
        if dice.random() < 0.6:
            lines += [f"pretravel = {abs(some(0.008))}", f"axial_pretravel = {abs(some(0.004))}", f"lobing = {abs(some(0.0008))}",
                      f"repeatability = {abs(some(0.0005))}", f"tip_offset = [{some(0.02)}, {some(0.02)}]"]
        if dice.random() < 0.3:
            lines += ["orient = true"]
        lines += ["[[tool]]", "number = 2", 'name = "MILL"', 'kind = "mill"', "length = 90.5", "radius = 6.0"]
        frame = "preset" if control in ("TNC640", "iTNC530") else "zero_offset"
        for number in (1, 2):
            key = f"row = {number}" if frame == "preset" else f'name = "{("G54", "G55")[number - 1]}"'
            shift = 0 if number == 1 else 0.1
            lines += [f"[[{frame}]]", key, f"origin = [{origin[0] + shift:.4f}, {origin[1]:.4f}, {origin[2] + shift:.4f}]"]
            if number == 1:
                lines += ["active = true"]
        if dice.random() < 0.5:
            lines += ["[errors.axis.X]", f"scale_mm_per_m = {some(0.03)}", f"backlash = {abs(some(0.003))}",
                      "[errors.axis.Y]", f"scale_mm_per_m = {some(0.03)}",
                      "[[errors.squareness]]", 'axis = "Y"', 'towards = "X"', f"degrees = {some(0.003)}"]
        return "\n".join(lines) + "\n"
