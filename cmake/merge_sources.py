"""Merges source files into one that compiles in place of them: what their headers instantiate is then made once for all.

   merge_sources.py OUTPUT SOURCE...

Each file keeps its unnamed namespace to itself, as that gets another one inside it. Messages of the compiler name the lines of the
files themselves, by their way from the build folder: so the text is the same wherever the project lies, and caches know it again."""

import os
import pathlib
import re
import sys


def merged(paths, start):
    for number, path in enumerate(paths):
        own = "of_" + re.sub(r"\W", "_", path.stem) + f"_{number}"
        yield f'#line 1 "{os.path.relpath(path, start)}"'
        for line in path.read_text(encoding="utf-8").splitlines():
            if line == "namespace {":
                line += f" namespace {own} {{"
            elif line == "}  // namespace":
                line = "} " + line
            yield line
        yield ""


output, *sources = map(pathlib.Path, sys.argv[1:])
output.write_text("\n".join(merged(sources, output.parent.parent)), encoding="utf-8")
