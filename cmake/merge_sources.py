"""Merges source files into one that compiles in place of them: what their headers instantiate is then made once for all.

   merge_sources.py OUTPUT SOURCE...

All headers come first. A name that a file has for itself (in an unnamed namespace) and that stands in another file of the group,
too, gets the name of its file behind it, so that no file sees what is another's. Messages of the compiler name the lines of the
files themselves, by their way from the build folder: so the text is the same wherever the project lies, and caches know it again.

It does not read C++ in full. A field or a function of another file that has such a name, in the same file, is renamed in part and
does not compile: give one of them another name. What a file says with `using` outside of its functions holds for the files after it,
too; where that is ambiguous, it does not compile either."""

import os
import pathlib
import re
import sys

TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/                                   # comments
      | R"(?P<end>\w*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"   # texts
      | '(?:\\.|[^'\\\n])+'                                  # characters
      | \.?\d(?:'?\w|[eEpP][+-]|\.)*                         # numbers
      | [A-Za-z_]\w*|::|->|.""",
    re.DOTALL | re.VERBOSE)
# Words that stand where a name may stand, macros that look like functions, and what gtest finds by its name.
NOT_NAMES = set("alignas auto bool char const constexpr decltype double else enum float for if int long noexcept operator return short "
                "signed sizeof static struct class switch template typename union unsigned using void while Handle PrintTo TEST TEST_F TEST_P "
                "TYPED_TEST TYPED_TEST_SUITE INSTANTIATE_TEST_SUITE_P MATCHER MATCHER_P MATCHER_P2 MATCHER_P3".split())


def tokens(text):
    """The tokens that mean something; instructions of the preprocessor do not count."""
    found = (match[0] for match in TOKEN.finditer(re.sub(r"^#.*$", "", text, flags=re.MULTILINE)))
    return [token for token in found if not token.isspace() and not token.startswith(("//", "/*"))]


def declared(statement):
    """The name that a declaration gives, which begins with these tokens and goes on with one of ( = { ; [, or None."""
    words = statement
    if words[:1] == ["template"]:
        depth = 0
        for place, word in enumerate(words):
            depth += (word == "<") - (word == ">")
            if word == ">" and depth == 0:
                words = words[place + 1:]
                break
    while words[:2] == ["[", "["]:
        words = words[words.index("]") + 2:]
    while words[:1] and words[0] in ("const", "constexpr", "inline", "static"):
        words = words[1:]
    if words[:2] == ["Handle", "("]:
        words = words[:1] + words[words.index(")") + 1:] if ")" in words else []
    if not words or "operator" in words or "=" in words or "(" in words:
        return None
    if words[0] in ("class", "enum", "struct", "union"):
        words = ["type", *(word for word in words[1:] if word not in ("class", "struct"))][:2]
    if words[0] == "using":
        words = words[:2] if len(words) == 2 else []
    if len(words) < 2 or words[-2] == "::" or words[-1] in NOT_NAMES or not re.match(r"[A-Za-z_]", words[-1]):
        return None
    return words[-1]


def own_names(words):
    """What the unnamed namespaces among these tokens declare."""
    names = set()
    braces = brackets = 0
    unnamed = None  # the depth of braces in such a namespace
    statement = []
    before = None
    for word in words:
        if unnamed is not None and braces == unnamed and brackets == 0:
            if word in ("(", "=", "{", ";", "["):
                names.add(declared(statement))
        if word in ("(", ")"):
            brackets += 1 if word == "(" else -1
        elif word == "{":
            braces += 1
            if before == "namespace" and unnamed is None:
                unnamed = braces
                statement = []
                before = word
                continue
        elif word == "}":
            braces -= 1
            if unnamed is not None and braces <= unnamed:
                unnamed = unnamed if braces == unnamed else None
                statement = []
                before = word
                continue
        if braces == unnamed:
            if brackets == 0 and word in (";", ","):
                statement = [] if word == ";" else ["type"]  # after a comma one more of the same type
            else:
                statement.append(word)
        before = word
    return names - {None}


def renamed(text, names, suffix):
    before = ""
    for match in TOKEN.finditer(text):
        word = match[0]
        yield word + suffix if word in names and before not in (".", "->", "::") else word
        if not word.isspace() and not word.startswith(("//", "/*")):
            before = word


def merged(paths, start):
    texts = [path.read_text(encoding="utf-8") for path in paths]
    words = [tokens(text) for text in texts]
    bodies = []
    for number, (path, text) in enumerate(zip(paths, texts)):
        place = os.path.relpath(path, start)
        bodies.append(f'#line 1 "{place}"')
        lines = text.splitlines()
        for index, line in enumerate(lines):
            if line.startswith("#include"):
                yield f'#line {index + 1} "{place}"'
                yield line
                lines[index] = ""
        elsewhere = set().union(*(other for i, other in enumerate(words) if i != number))
        shared = own_names(words[number]) & elsewhere
        bodies.append("".join(renamed("\n".join(lines), shared, f"_of_{re.sub(r'[^a-zA-Z0-9]', '_', path.stem)}")))
    yield from bodies
    yield ""


if __name__ == "__main__":
    output, *sources = map(pathlib.Path, sys.argv[1:])
    output.write_text("\n".join(merged(sources, output.parent.parent)), encoding="utf-8")
