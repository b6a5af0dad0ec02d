"""SINUMERIK programs on the plate of random_worlds.py, for random_programs.py."""

from random_worlds import HOLE, POCKET, STUD, BLOCK, SLOT, RING, BALL, HEIGHT, CLEAR

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
