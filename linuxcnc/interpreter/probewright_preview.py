# SPDX-License-Identifier: GPL-2.0-or-later
"""For screens of LinuxCNC 2.9 whose preview reads every file as G-code, whatever [TASK]INTERPRETER says: QtVCP, gmoccapy.

    [DISPLAY]
    USER_COMMAND_FILE = /path/of/probewright_preview.py

From then on their preview asks the interpreter of the configuration. Screens run this file within a function of theirs, so
that nothing here may count on names of the file when it is called later.
"""
import ctypes
import os

import gcode
import linuxcnc


_named = linuxcnc.ini(os.environ["INI_FILE_NAME"]).find("TASK", "INTERPRETER") or ""


def _parse(file, canvas, *codes, _own=gcode.parse, _interpreter=_named):
    if _interpreter and len(codes) < 3 and all(isinstance(code, str) for code in codes):
        codes = (*codes, "", "")[:2] + (_interpreter,)
    return _own(file, canvas, *codes)


# The interpreter finds what it draws with in the module of the screen.
ctypes.CDLL(gcode.__file__, ctypes.RTLD_GLOBAL)
gcode.parse = _parse
