"""Writes the entries for ctest of a test program, one a suite: a process costs more than most tests.

   list_suites.py PROGRAM OUTPUT RESULTS NAME [PROPERTY VALUE]...

OUTPUT is what ctest reads. An entry is called NAME.SUITE; what its tests have noted is in RESULTS/SUITE.xml after it."""

import pathlib
import subprocess
import sys


def suites(program):
    """The suites of the program that have tests which run, in its order."""
    text = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, encoding="utf-8", timeout=60).stdout
    found = {}
    suite = ""
    for line in text.splitlines():
        words = line.split("#")[0].strip()  # what follows tells a type or a parameter
        if not line.startswith(" "):
            suite = words.removesuffix(".")
        elif "DISABLED_" not in suite + words:
            found[suite] = found.get(suite, 0) + 1
    return found


def entry(name, words):
    """Text of CMake; its brackets need no quoting."""
    return f"add_test({bracket(name)} {' '.join(map(bracket, words))})\n"


def bracket(word):
    return f"[==[{word}]==]"


program, output, results, name, *properties = sys.argv[1:]
text = ""
for suite, count in suites(program).items():
    file = suite.replace("/", ".")
    text += entry(f"{name}.{suite}", [program, f"--gtest_filter={suite}.*", f"--gtest_output=xml:{results}/{file}.xml"])
    # Those with many tests take long as a rule, and begin first.
    text += f"set_tests_properties({bracket(f'{name}.{suite}')} PROPERTIES COST {count} {' '.join(map(bracket, properties))})\n"
pathlib.Path(output).write_text(text, encoding="utf-8")
