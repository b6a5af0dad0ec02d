"""HEIDENHAIN programs on the plate of random_worlds.py, for random_programs.py."""

import math

from random_worlds import HOLE, POCKET, BOLTS, STUD, BLOCK, SLOT, STUD2, RING, BALL, CLEAR

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
