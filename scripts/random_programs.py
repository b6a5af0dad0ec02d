"""Measuring programs in random worlds, for scripts/record-outputs. The same number always gives the same case.

Every world has a plate with the features below at places that programs know to a millimetre; where the plate lies, how large
the features came out and what machine and probe get wrong is random. The plate's frame is the program's: X along the long side, Z0 the
top face, so each cycle can be called without knowing the others.
"""

import math
import random

import random_machine_programs

# What a case consists of: the setup, the program's file name and text, and further words for the command line.
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


# ---------------------------------------------------------------- HEIDENHAIN

# The parameters of each cycle in the order of its block.
ORDER = {
    400: "263 264 265 266 272 267 261 320 260 301 307 305",
    401: "268 269 270 271 261 260 307 305 402 337",
    402: "268 269 313 261 270 271 314 315 320 260 301 307 305 402 337",
    403: "263 264 265 266 272 267 261 320 260 301 312 337 305 303 380",
    405: "321 322 262 325 247 261 320 260 301 337",
    408: "321 322 311 272 261 320 260 301 305 405 303 381 382 383 384 333",
    409: "321 322 311 272 261 320 260 305 405 303 381 382 383 384 333",
    410: "321 322 323 324 261 320 260 301 305 331 332 303 381 382 383 384 333",
    411: "321 322 323 324 261 320 260 301 305 331 332 303 381 382 383 384 333",
    412: "321 322 262 325 247 261 320 260 301 305 331 332 303 381 382 383 384 333 423 365",
    413: "321 322 262 325 247 261 320 260 301 305 331 332 303 381 382 383 384 333 423 365",
    414: "263 264 326 296 297 327 261 320 260 301 304 305 331 332 303 381 382 383 384 333",
    415: "263 264 326 327 308 261 320 260 301 304 305 331 332 303 381 382 383 384 333",
    416: "273 274 262 291 292 293 261 260 305 331 332 303 381 382 383 384 333",
    417: "263 264 294 320 260 305 333 303",
    418: "268 269 270 271 316 317 318 319 261 260 305 331 332 303 381 382 383 384 333",
    419: "263 264 261 320 260 272 267 305 333 303",
    420: "263 264 265 266 272 267 261 320 260 301 281",
    421: "273 274 262 325 247 261 320 260 301 275 276 279 280 281 309 330 423 365",
    422: "273 274 262 325 247 261 320 260 301 277 278 279 280 281 309 330 423 365",
    423: "273 274 282 283 261 320 260 301 284 285 286 287 279 280 281 309 330",
    424: "273 274 282 283 261 320 260 301 284 285 286 287 279 280 281 309 330",
    425: "328 329 310 272 261 260 311 288 289 281 309 330 320 301",
    426: "263 264 265 266 272 261 320 260 311 288 289 281 309 330",
    427: "263 264 261 320 272 267 260 281 288 289 309 330",
    430: "273 274 262 291 292 293 261 260 288 289 279 280 281 309 330",
    431: "263 264 294 265 266 295 296 297 298 320 260 281",
    441: "396 397 399 400",
    444: "263 264 294 581 582 583 320 260 309",
    450: "410 409",
    460: "407 320 301 423 380 433 434",
    462: "407 320 423 380",
    1410: "1100 1101 1102 1103 1104 1105 372 320 260 1125 309 1126 1120 1121",
    1411: "1100 1101 1102 1116 1103 1104 1105 1117 1115 423 325 1119 320 260 1125 309 1126 1120 1121",
    1420: "1100 1101 1102 1103 1104 1105 1106 1107 1108 372 320 260 1125 309 1126 1120 1121",
}
NEWER = {444, 462, 1410, 1411, 1420}  # TNC 640 only
TURNING = {403, 405}  # turn a rotary table


class Klartext:
    def __init__(self, world, control):
        self.world, self.control, self.dice = world, control, world.dice

    def limits(self, nominal):
        """Largest and least size: about as wide as what the features came out by, so that all verdicts come up."""
        return round(nominal + self.dice.uniform(0.005, 0.08), 3), round(nominal - self.dice.uniform(0.005, 0.08), 3)

    def words(self, cycle):
        world, dice = self.world, self.dice
        row = dice.choice((1, 1, 3, 4))
        q = {320: round(dice.uniform(0.5, 2.5), 2), 260: CLEAR, 301: dice.randint(0, 1), 305: row, 303: 1, 307: 0, 402: 0, 337: 0,
             381: dice.randint(0, 1), 382: 75, 383: 75, 384: 0, 333: 0, 261: -dice.randint(4, 10), 281: dice.randint(0, 1), 309: 0,
             330: dice.choice((0, 0, 2)), 325: dice.randint(0, 90), 247: dice.choice((90, -90, 60)), 423: dice.choice((3, 4, 4)),
             365: dice.randint(0, 1), 279: 0.5, 280: round(dice.uniform(0.01, 0.5), 3), 267: 1, 312: 6, 380: 0, 304: dice.randint(0, 1),
             1125: dice.randint(0, 2), 1126: 0, 1120: 1, 1121: dice.randint(0, 1)}
        centre = {}
        if cycle in (405, 412, 421):
            centre = {262: world.hole[0], 275: self.limits(world.hole[0])[0], 276: self.limits(world.hole[0])[1]}
            place = HOLE
        elif cycle in (413, 422):
            centre = {262: world.stud[0], 261: 7, 277: self.limits(world.stud[0])[0], 278: self.limits(world.stud[0])[1]}
            place = STUD
        elif cycle in (410, 423):
            place, sides = POCKET, world.pocket
        elif cycle in (411, 424):
            place, sides = BLOCK, world.block
            centre = {261: 7}
        elif cycle in (408, 425):
            place = SLOT
            centre = {311: world.slot[0], 272: 2, 328: SLOT[0], 329: SLOT[1], 310: 0, 405: SLOT[1]}
            centre[288], centre[289] = self.limits(world.slot[0])
        elif cycle in (409, 426):
            place = BLOCK
            axis = dice.randint(1, 2)
            half = world.block[axis - 1][0] / 2
            centre = {311: world.block[axis - 1][0], 272: axis, 261: 6, 405: BLOCK[axis - 1]}
            centre.update({263: BLOCK[0] + (half if axis == 1 else 0), 264: BLOCK[1] + (half if axis == 2 else 0),
                           265: BLOCK[0] - (half if axis == 1 else 0), 266: BLOCK[1] - (half if axis == 2 else 0)})
            centre[288], centre[289] = self.limits(centre[311])
        elif cycle in (416, 430):
            place = BOLTS
            centre = {262: world.bolts[0], 291: world.first_bolt, 292: world.first_bolt + 90, 293: world.first_bolt + 180}
            centre[288], centre[289] = self.limits(world.bolts[0])
        elif cycle in (401, 418):
            place = BOLTS
            for index, (first, second) in enumerate(((268, 269), (270, 271), (316, 317), (318, 319))):
                at = world.bolt_centre((0, 1, 2, 3)[index])
                centre[first], centre[second] = round(at[0], 4), round(at[1], 4)
            if cycle == 401:
                centre[307] = world.first_bolt + 135
        else:
            place = (0, 0)
        if cycle in (410, 411, 423, 424):
            centre.update({282: sides[0][0], 283: sides[1][0], 323: sides[0][0], 324: sides[1][0]})
            centre[284], centre[285] = self.limits(sides[0][0])
            centre[286], centre[287] = self.limits(sides[1][0])
        q.update({321: place[0], 322: place[1], 273: place[0], 274: place[1], 331: place[0], 332: place[1]})
        q.update(centre)
        if cycle in (400, 403, 420):
            if dice.random() < 0.5:
                q.update({263: 15, 264: 0, 265: 220, 266: 0, 272: 2})
            else:
                q.update({263: 0, 264: 15, 265: 0, 266: 140, 272: 1})
                q[307] = 90 if cycle == 400 else 0
                q[380] = 90
        if cycle == 402:
            q.update({268: STUD[0], 269: STUD[1], 313: world.stud[0], 270: STUD2[0], 271: STUD2[1], 314: 12, 261: 7, 315: 7})
            q[307] = round(math.degrees(math.atan2(STUD2[1] - STUD[1], STUD2[0] - STUD[0])), 4)
        if cycle == 414:
            q.update({263: 20, 264: 0, 326: 150, 296: 0, 297: 15, 327: 100})
        if cycle == 415:
            half = [side[0] / 2 for side in world.pocket]
            q.update({263: POCKET[0] - half[0], 264: POCKET[1] - half[1], 326: 12, 327: 10, 308: 1, 331: POCKET[0] - half[0],
                      332: POCKET[1] - half[1]})
        if cycle == 417:
            q.update({263: 75, 264: 75, 294: 0})
        if cycle in (419, 427):
            axis = dice.randint(1, 3)
            q.update({263: 0 if axis == 1 else 75, 264: 0 if axis == 2 else 75, 261: 0 if axis == 3 else -8, 272: axis,
                      267: -1 if axis == 3 else 1, 333: 0})
            q[288], q[289] = self.limits(0)
        if cycle == 431:
            q.update({263: 10, 264: 10, 294: 0, 265: 225, 266: 10, 295: 0, 296: 75, 297: 75, 298: 0})
        if cycle == 441:
            q.update({396: 3000, 397: dice.randint(0, 1), 399: dice.randint(0, 1), 400: 0})
        if cycle == 444:
            q.update({263: 0, 264: 75, 294: -8, 581: -1, 582: 0, 583: 0} if dice.random() < 0.5 else
                     {263: 75, 264: 75, 294: 0, 581: 0, 582: 0, 583: 1})
        if cycle == 450:
            q.update({410: dice.choice((0, 2)), 409: dice.randint(0, 9)})
        if cycle == 460:
            q.update({407: world.ball / 2, 433: dice.randint(0, 1), 434: BALL[2], 423: 4})
        if cycle == 462:
            q.update({407: world.ring / 2})
        if cycle == 1410:
            q.update({1100: 15, 1101: 0, 1102: -8, 1103: 220, 1104: 0, 1105: -8, 372: 2})
        if cycle == 1411:
            q.update({1100: HOLE[0], 1101: HOLE[1], 1102: -8, 1116: world.hole[0], 1103: STUD[0], 1104: STUD[1], 1105: 7,
                      1117: world.stud[0], 1115: 2, 325: 0, 1119: 360})
        if cycle == 1420:
            q.update({1100: 10, 1101: 10, 1102: 0, 1103: 225, 1104: 10, 1105: 0, 1106: 75, 1107: 75, 1108: 0, 372: -3})
        return [(int(number), q[int(number)]) for number in ORDER[cycle].split()]

    def cycle(self, cycle):
        before = ""
        if cycle == 460:
            before = f"L X{BALL[0]:+d} Y{BALL[1]:+d} R0 FMAX\nL Z{BALL[2] + self.world.ball / 2 + 6:+.3f} R0 FMAX\n"
        if cycle == 462:
            before = f"L X{RING[0]:+d} Y{RING[1]:+d} R0 FMAX\nL Z-8 R0 FMAX\n"
        words = self.words(cycle)
        if self.dice.random() < 0.2 and words:  # A value by way of a parameter.
            index = self.dice.randrange(len(words))
            before += f"FN 0: Q{20 + index} = {words[index][1]:+.4f}\n"
            words[index] = (words[index][0], f"+Q{20 + index}")
        text = f"TCH PROBE {cycle} MEASURE"
        for number, value in words:
            text += f" ~\n  Q{number}={value if isinstance(value, str) else format(value, '+.4f')} ;VALUE"
        return before + text + f"\nL Z{CLEAR + 20:+d} R0 FMAX\n"

    def old(self):
        """A block of the cycles 0, 3 and 4: from beside the plate to its side, or from above."""
        axis = self.dice.choice("XYZ")
        start = {"X": (-10, 75, -8), "Y": (75, -10, -8), "Z": (75, 75, 8)}[axis]
        way = f"L X{start[0]:+d} Y{start[1]:+d} R0 FMAX\nL Z{start[2]:+d} R0 FMAX\n"
        sign = "-" if axis == "Z" else "+"
        kind = self.dice.choice((0, 3, 4))
        if kind == 0:
            # The block's position is where the touch begins.
            block = f"TCH PROBE 0.0 REF. PLANE Q10 {axis}{sign}\nTCH PROBE 0.1 X{start[0]:+d} Y{start[1]:+d} Z{start[2]:+d}\n"
        elif kind == 3:
            angle = {"X": "X ANGLE: +0", "Y": "Y ANGLE: +90", "Z": "Z ANGLE: -90"}[axis]
            if axis == "Z":
                angle = "X ANGLE: +0"
                way = "L X-10 Y+75 R0 FMAX\nL Z-8 R0 FMAX\n"
            if axis == "Y":
                angle = "X ANGLE: +90"
            block = (f"TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 {angle}\n"
                     "TCH PROBE 3.3 ABST+20 F150 MB4 REFERENCE SYSTEM:0\nTCH PROBE 3.4 ERRORMODE1\n")
        else:
            block = (f"TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 I{axis}{sign}1 "
                     + " ".join(f"I{other}+0" for other in "XYZ" if other != axis)
                     + "\nTCH PROBE 4.3 ABST+20 F150 MB4 REFERENCE SYSTEM:0\n")
        return way + block + f"L Z{CLEAR + 20:+d} R0 FMAX\n"

    def path(self):
        """Contours, circles and calls far above the part: what a path needs without anything to hit."""
        dice = self.dice
        side = dice.choice(("RL", "RR", "R0"))
        size = dice.randint(20, 60)
        return (f"TOOL CALL 2 Z S1000 F800\nL X+0 Y-20 Z{CLEAR + 60:+d} R0 FMAX\nL X+10 Y+10 {side} F500\n"
                f"L Y{10 + size:+d}\nCHF {dice.randint(1, 4)}\nL X{10 + size:+d}\nRND R{dice.randint(7, 9)}\nL Y+10\n"
                f"CR X+10 Y+10 R{size:+d} DR{dice.choice('+-')}\nL X-30 Y-30 R0\n"
                f"CC X+50 Y+50\nLP PR+{size} PA+30 F600\nCP PA+120 DR+\n"
                "TOOL CALL 1 Z\n")

    def planes(self):
        """The tool stands square to a tilted plane and comes back."""
        dice = self.dice
        kind = dice.choice(("SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f}", "VECTOR BX+1 BY{0:+.3f} BZ+0 NX+0 NY{1:+.3f} NZ+1"))
        if kind.startswith("SPATIAL"):
            plane = kind.format(*(dice.uniform(-25, 25) for _ in range(3)))
        else:
            plane = kind.format(0, dice.uniform(-0.3, 0.3))
        return (f"L Z-1 R0 FMAX M91\nPLANE {plane} {dice.choice(('MOVE DIST50 F2000', 'TURN F2000'))} SEQ{dice.choice('+-')}\n"
                "Q60 = Q120\nQ61 = Q121\nQ62 = Q122\nL Z-1 R0 FMAX M91\n"
                f"PLANE RESET {dice.choice(('MOVE DIST50 F2000', 'TURN F2000'))}\nL Z-1 R0 FMAX M91\n")

    def shift(self):
        dice = self.dice
        x, y = dice.randint(-20, 20), dice.randint(-20, 20)
        return (f"CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X{x:+d}\nCYCL DEF 7.2 Y{y:+d}\n"
                f"L X{75 - x:+d} Y{75 - y:+d} R0 FMAX\nL Z+8 R0 FMAX\n"
                f"TCH PROBE 0.0 REF. PLANE Q11 Z-\nTCH PROBE 0.1 X{75 - x:+d} Y{75 - y:+d} Z+6\nL Z{CLEAR + 20:+d} R0 FMAX\n"
                "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\n")

    def program(self):
        dice = self.dice
        fits = [cycle for cycle in ORDER if (self.control == "TNC640" or cycle not in NEWER)
                and (cycle not in TURNING or self.world.machine.endswith("-table"))]
        text = f"TOOL CALL 1 Z\nL Z{CLEAR + 20:+d} R0 FMAX\n"
        for index in range(dice.randint(2, 5)):
            kind = dice.random()
            if kind < 0.72:
                text += self.cycle(dice.choice(fits))
            elif kind < 0.82:
                text += self.old()
            elif kind < 0.88:
                text += self.path()
            elif kind < 0.94:
                text += self.shift()
            elif self.world.machine.startswith("mill5"):
                text += self.planes()
            else:
                text += (f"Q50 = 0\nLBL {10 + index}\nQ50 = Q50 + {dice.randint(1, 3)} * SIN 30\n"
                         f"FN 12: IF +Q50 LT +{dice.randint(2, 6)} GOTO LBL {10 + index}\n")
            if dice.random() < 0.3:
                text += f"CYCL DEF 247 PRESETTING ~\n  Q339=+{dice.choice((1, 1, 2))} ;PRESET\nL Z{CLEAR + 20:+d} R0 FMAX\n"
        return f"BEGIN PGM RANDOM MM\n{text}M30\nEND PGM RANDOM MM\n"


# ---------------------------------------------------------------- SINUMERIK

SIGNATURES = {
    961: "MVAR KNUM PRNUM SETV0 SETV1 SETV2 SETV3 SETV4 SETV5 SETV6 SETV7 SETV8 SETV9 STA1 INCA ID FA TSA NMSP MCBIT _DMODE _AMODE",
    973: "MVAR PRNUM CALNUM SETV MA MD FA TSA VMS NMSP MCBIT _DMODE _AMODE",
    982: "MVAR KNUM PRNUM MA MD ID FA TSA VMS STA1 CORA TZL TDIF NMSP EVNUM MCBIT _DMODE _AMODE",
    974: "MVAR KNUM KNUM1 PRNUM SETV MA FA TSA STA1 NMSP TNAME DLNUM TZL TDIF TUL TLL TMV K EVNUM MCBIT _DMODE _AMODE",
    976: "MVAR PRNUM SETV SETV0 MA MD FA TSA VMS STA1 NMSP MCBIT _DMODE _AMODE",
    977: "MVAR KNUM KNUM1 PRNUM SETV SETV0 SETV1 FA TSA STA1 ID SZA SZO MA NMSP TNAME DLNUM TZL TDIF TUL TLL TMV K EVNUM MCBIT _DMODE "
         "_AMODE",
    978: "MVAR KNUM KNUM1 PRNUM SETV FA TSA MA MD NMSP TNAME DLNUM TZL TDIF TUL TLL TMV K EVNUM MCBIT _DMODE _AMODE",
    979: "MVAR KNUM KNUM1 PRNUM SETV FA TSA CPA CPO STA1 INCA NMSP TNAME DLNUM TZL TDIF TUL TLL TMV K EVNUM MCBIT _DMODE _AMODE",
    994: "MVAR KNUM KNUM1 PRNUM SETV MA SZA SZO FA TSA NMSP TNAME DLNUM TZL TDIF TUL TLL TMV K EVNUM MCBIT _DMODE _AMODE",
    997: "MVAR KNUM PRNUM SETV FA TSA STA1 INCA SETV0 SETV1 SETV2 SETV3 SETV4 SETV5 SETV6 SETV7 SETV8 TNVL NMSP MCBIT _DMODE _AMODE",
    998: "MVAR KNUM RA PRNUM SETV STA1 INCA FA TSA MA MD ID SETV0 SETV1 SETV2 SETV3 NMSP EVNUM _DMODE _AMODE",
}


def call(cycle, **words):
    """The call with each argument at its place."""
    arguments = []
    for name in SIGNATURES[cycle].split():
        value = words.pop(name, None)
        arguments.append("" if value is None else f'"{value}"' if isinstance(value, str) else f"{value}")
    assert not words, words
    return f"CYCLE{cycle}({','.join(arguments)})\n"


class Sinumerik:
    def __init__(self, world):
        self.world, self.dice = world, world.dice

    def task(self, feature, tolerance=0.05):
        """What a measurement is for: nothing, the zero offset or the mill."""
        dice = self.dice
        task = dice.choice((0, 1, 2))
        words = {"MVAR": feature + 100 * task, "PRNUM": 1, "NMSP": dice.choice((1, 1, 2)), "TSA": 4}
        if task == 1:
            words["KNUM"] = dice.choice((1, 2, 10001))
        if task == 2:
            words.update({"KNUM1": 1, "TNAME": "MILL", "TZL": 0.002, "TDIF": 0.5, "TUL": tolerance, "TLL": -tolerance, "TMV": 0.03,
                          "K": 1, "_AMODE": 1})
        return words

    def cycle(self, cycle):
        world, dice = self.world, self.dice
        go = lambda place, height: f"G0 X{place[0]:g} Y{place[1]:g}\nG1 Z{height:g} F3000\n"
        if cycle == 977:
            kind = dice.randint(1, 6)
            words = self.task(kind)
            words.update({"FA": 3, "STA1": 0})
            place, height = {1: (HOLE, -8), 2: (STUD, HEIGHT + 8), 3: (SLOT, -6), 4: (BLOCK, HEIGHT + 8), 5: (POCKET, -8),
                             6: (BLOCK, HEIGHT + 8)}[kind]
            axis = 2 if kind == 3 else dice.randint(1, 2)
            if kind in (1, 2):
                words["SETV"] = (world.hole if kind == 1 else world.stud)[0]
                words["STA1"] = dice.choice((0, 0, 30, 45))
            elif kind in (3, 4):
                words.update({"SETV": (world.slot if kind == 3 else world.block[axis - 1])[0], "MA": axis})
            else:
                sides = world.pocket if kind == 5 else world.block
                words.update({"SETV0": sides[0][0], "SETV1": sides[1][0]})
            if kind in (2, 4, 6):
                words["ID"] = -16
            else:
                words["FA"] = 2
            return go(place, height) + call(977, **words)
        if cycle == 978:
            axis = dice.randint(1, 3)
            words = self.task(0)
            words.update({"SETV": 0, "FA": 6, "MA": axis, "MD": 2 if axis == 3 else 1})
            return go({1: (-8, 75), 2: (75, -8), 3: (75, 75)}[axis], 6 if axis == 3 else -8) + call(978, **words)
        if cycle == 979:
            words = self.task(1)
            words["MVAR"] += dice.choice((0, 1000))
            words.update({"SETV": world.hole[0], "FA": 2, "CPA": HOLE[0], "CPO": HOLE[1], "STA1": dice.randint(0, 60), "INCA": 70})
            return go(HOLE, -8) + call(979, **words)
        if cycle == 976:
            if dice.random() < 0.5:
                return "G55\n" + go(RING, -6) + call(976, MVAR=2, PRNUM=1, SETV=world.ring, MA=1, MD=0, FA=4, TSA=2, STA1=0, NMSP=1) + "G54\n"
            return go((75, 75), 8) + call(976, MVAR=1000000, PRNUM=1, SETV=0, MA=3, MD=1, FA=8, TSA=3, NMSP=1)
        if cycle == 998:
            if dice.random() < 0.6:
                return go((12, -10), -8) + call(998, MVAR=105 if dice.random() < 0.5 else 100105, KNUM=10001, RA=0, PRNUM=1, STA1=0, FA=8,
                                                 TSA=5, MA=102, MD=1, ID=180, NMSP=1, SETV=0)
            return go((10, 10), 6) + call(998, MVAR=106, KNUM=10001, RA=0, PRNUM=1, STA1=0, INCA=0, FA=6, TSA=5, MD=2, SETV0=200, SETV2=60,
                                           SETV3=65, NMSP=1)
        if cycle == 961:
            return go((-15, -15), -8) + call(961, MVAR=dice.choice((6, 106)), KNUM=10001, PRNUM=1, SETV0=40, SETV1=130, SETV2=40, SETV4=-15,
                                             SETV5=-15, SETV8=0, SETV9=0, STA1=0, FA=22, TSA=3, NMSP=1)
        if cycle == 997:
            words = {"MVAR": dice.choice((9, 109, 1009, 101009)), "KNUM": 2, "PRNUM": 1, "SETV": world.ball, "FA": 6, "TSA": 4, "STA1": 0,
                     "INCA": 90, "SETV0": BALL[0], "SETV1": BALL[1], "SETV2": BALL[2], "NMSP": 1}
            return go(BALL, BALL[2] + world.ball / 2 + 6) + call(997, **words)
        raise KeyError(cycle)

    def path(self):
        dice = self.dice
        size = dice.randint(20, 60)
        return (f'T="MILL"\nM6 D1\nG0 X0 Y-20 Z{CLEAR + 60}\n{dice.choice(("G41", "G42", "G40"))} G1 X10 Y10 F500\nY{10 + size} '
                f"CHF={dice.randint(1, 4)}\nX{10 + size} RND={dice.randint(7, 9)}\nY10\n{dice.choice(('G2', 'G3'))} X10 Y10 CR={size}\n"
                f'G40 G1 X-30 Y-30\nG0 Z{CLEAR + 60}\nT="PROBE"\nM6 D1\nG0 Z{CLEAR + 20}\n')

    def swivel(self):
        dice = self.dice
        zero = "B0 C0" if self.world.machine == "mill5-head-table" else "A0 C0"
        angles = ",".join(f"{dice.uniform(-30, 30):.3f}" for _ in range(3))
        return (f'SUPA G0 Z-1 D0\nD1\nCYCLE800(0,"",0,{dice.choice((27, 57, 39))},0,0,0,{angles},0,0,0,{dice.choice((1, -1))})\n'
                f"R10=$P_UIFR[1,X,TR]\nSUPA G0 Z-1 D0\nD1\nCYCLE800()\nSUPA G0 Z-1 D0\nSUPA G0 {zero}\nD1\n")

    def block(self):
        """A measuring block of the language."""
        return (f"G0 X75 Y75\nG1 Z8 F3000\n{self.dice.choice(('MEAS=1 G1 Z-4', 'MEAW=1 G1 Z-1.5'))} F150\nSTOPRE\nR20=$AA_MW[Z]\nR21=$AA_MM[Z]\n"
                f"G0 Z{CLEAR + 20}\n")

    def program(self):
        dice = self.dice
        text = f'G17 G90 G71 G94 G54\nT="PROBE"\nM6 D1\nG0 Z{CLEAR + 20}\n'
        for index in range(dice.randint(2, 5)):
            kind = dice.random()
            if kind < 0.75:
                text += self.cycle(dice.choice((961, 976, 977, 977, 977, 978, 978, 979, 997, 998))) + f"G0 Z{CLEAR + 20}\n"
            elif kind < 0.82:
                text += self.path()
            elif kind < 0.88:
                text += self.block()
            elif self.world.machine.startswith("mill5"):
                text += self.swivel()
            else:
                text += f"R1=0\nWHILE R1<{dice.randint(2, 6)}\nR1=R1+{dice.randint(1, 3)}*SIN(30)\nENDWHILE\n"
            text += f"R{30 + index}=_OVR[4]\n"
        return text + "M30\n"


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


def case(number):
    """Setup and program number `number`: a pair of names and texts."""
    dice = random.Random(7919 * number + 11)
    if number % 10 == 9:
        setup, program = turned(dice)
        return setup, "random.mpf", program
    control = ("TNC640", "840Dsl", "iTNC530", "828D", "TNC640", "840Dsl")[number % 6]
    if number % 10 in (4, 7):
        return random_machine_programs.case(dice, control)
    world = World(dice, dice.choice(MILLS))
    setup = world.setup(control)
    if control in ("840Dsl", "828D"):
        return setup, "random.mpf", Sinumerik(world).program()
    return setup, "random.h", Klartext(world, control).program()
