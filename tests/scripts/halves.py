#!/usr/bin/env python3
"""halves.py FILE [--budgets] - shade.h has three parts: the renderer (to the banner of >>lines), the
tools behind it, and the explanations (from >>replay on), which SHADE_NO_EXPLAIN leaves out.

Prints each line of a part's implementation that names a function, type or constant of a later part.
--budgets prints instead each part with more C tokens than its ceiling.  Releases hold the ceilings,
commits need not: they are there so that the file does not grow unseen, not to forbid a clearer form.
"""
import re
import sys

CEILING = {"renderer": 49500, "tools": 14500, "explanations": 13500}
# A table that holds nothing but numbers, or numbers and their names, is data: one token.
TABLE = re.compile(r'(static const \w+ \w+\[\w*\] = )\{(?:[-{}\s0-9a-zA-Z.,]|"[^"]*")*\}(?=;)')
TOKEN = re.compile(
    r"""
    "(?:[^"\\]|\\.)*" | '(?:[^'\\]|\\.)*'                  # strings, characters
    | [A-Za-z_]\w*                                        # names
    | \.?[0-9](?:[eEpP][-+]|[.\w])*                       # numbers
    | \.\.\. | <<= | >>= | [-+&|<>=#]{2} | [-+*/%&|^<>=!]= # operators of several characters
    | \S""",
    re.VERBOSE,
)


def code_of(text):
    """Returns the text with each comment as blanks, so that lines keep their numbers."""
    def blanks(match):
        return " " + "\n" * match.group().count("\n")
    return re.sub(r"/\*.*?\*/", blanks, text, flags=re.DOTALL)


def parts_of(text):
    """Returns the three parts by name, in order, without comments."""
    def banner(tag):
        return re.search(r"/\*-+ >>%s\n" % tag, text).start()

    lines, replay, refs = map(banner, ("lines", "replay", "refs"))
    parts = {"renderer": text[:lines], "tools": text[lines:replay], "explanations": text[replay:refs]}
    return {name: code_of(part) for name, part in parts.items()}


def over_budget(parts):
    for name, code in parts.items():
        code = TABLE.sub(r"\1 0", code.replace("\\\n", " "))
        tokens = len(TOKEN.findall(code))
        if tokens > CEILING[name]:
            yield f"the {name} have {tokens} tokens, {tokens - CEILING[name]} beyond the ceiling"


def names_of(code):
    defined = r"^(?:static|SHADEDEF|SHADE__INLINE)\b[^;{}()=]*?\b(\w+)\((?=[^;]*?\)\s*\{)"
    names = set(re.findall(defined, code, re.MULTILINE))
    names |= set(re.findall(r"^\} (shade__\w+);", code, re.MULTILINE))
    return names | set(re.findall(r"\b(SHADE__\w+) = ", code))


def named_early(parts):
    behind = names_of(parts["tools"]), names_of(parts["explanations"])
    later = {"renderer": behind[0] | behind[1], "tools": behind[1]}
    number, inside = 0, False
    for part in later:
        for line in parts[part].split("\n")[:-1]:
            number += 1
            inside |= line.startswith("#ifdef SHADE_IMPLEMENTATION")
            for name in re.findall(r"\w+", line) if inside else []:
                if name in later[part]:
                    yield f"{number}: the {part} name {name} of a later part"


def main():
    with open(sys.argv[1], encoding="ascii") as file:
        parts = parts_of(file.read())
    found = over_budget(parts) if "--budgets" in sys.argv else named_early(parts)
    for line in found:
        print(line)


main()
