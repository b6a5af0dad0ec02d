"""Measuring programs in random worlds, for scripts/record-outputs. The same number always gives the same case.

Where the parts lie, how large their features came out and what machine and probe get wrong is random; the worlds are those of
random_worlds.py, of a lathe and of machines that are measured themselves.
"""

import random

import random_lathe_programs
import random_machine_programs
from random_klartext_programs import Klartext
from random_sinumerik_programs import Sinumerik
from random_worlds import MILLS, World


def case(number):
    """Setup and program number `number`: a pair of names and texts."""
    dice = random.Random(7919 * number + 11)
    if number % 10 == 9:
        setup, program = random_lathe_programs.turned(dice)
        return setup, "random.mpf", program
    control = ("TNC640", "840Dsl", "iTNC530", "828D", "TNC640", "840Dsl")[number % 6]
    if number % 10 in (4, 7):
        return random_machine_programs.case(dice, control)
    world = World(dice, dice.choice(MILLS))
    setup = world.setup(control)
    if control in ("840Dsl", "828D"):
        return setup, "random.mpf", Sinumerik(world).program()
    return setup, "random.h", Klartext(world, control).program()
