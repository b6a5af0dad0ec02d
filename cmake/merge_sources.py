"""Merges source files into one that compiles in place of them: what their headers instantiate is then made once for all.

   merge_sources.py OUTPUT SOURCE...

Each file keeps its unnamed namespace to itself, as that gets another one inside it. Messages of the compiler name the lines of the
files themselves."""

import pathlib
import re
import sys


def merged(paths):
    for number, path in enumerate(paths):
        own = "of_" + re.sub(r"\W", "_", path.stem) + f"_{number}"
        yield f'#line 1 "{path}"'
        for line in path.read_text(encoding="utf-8").splitlines():
            if line == "namespace {":
                line += f" namespace {own} {{"
            elif line == "}  // namespace":
                line = "} " + line
            yield line
        yield ""


output, *sources = map(pathlib.Path, sys.argv[1:])
output.write_text("\n".join(merged(sources)), encoding="utf-8")
