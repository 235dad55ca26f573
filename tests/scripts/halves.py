#!/usr/bin/env python3
"""halves.py FILE - shade.h is a renderer (to the banner of >>lines) and the tools behind it, of
which the explanations (>>survey to >>replay) are a part of their own.

Prints what breaks the house's two rules of them: a part with more C tokens than its budget, and a
line of the renderer's implementation that names a function, type or constant of a tool.
"""
import re
import sys

BUDGET = {"renderer": 49500, "tools": 13000, "explanations": 13000}
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


def main():
    text = open(sys.argv[1], encoding="ascii").read()

    def banner(tag):
        return re.search(r"/\*-+ >>%s\n" % tag, text).start()

    lines, survey, image, refs = map(banner, ("lines", "survey", "image", "refs"))
    parts = {"renderer": text[:lines], "explanations": text[survey:image],
             "tools": text[lines:survey] + text[image:refs]}
    halves = {name: code_of(part) for name, part in parts.items()}
    for name, code in halves.items():
        tokens = len(TOKEN.findall(code.replace("\\\n", " ")))
        if tokens > BUDGET[name]:
            print(f"the {name} have {tokens} tokens, {tokens - BUDGET[name]} beyond the budget")

    defined = r"^(?:static|SHADEDEF|SHADE__INLINE)\b[^;{}()=]*?\b(\w+)\((?=[^;]*?\)\s*\{)"
    behind = halves["tools"] + halves["explanations"]
    tools = set(re.findall(defined, behind, re.MULTILINE))
    tools |= set(re.findall(r"^\} (shade__\w+);", behind, re.MULTILINE))
    tools |= set(re.findall(r"\b(SHADE__\w+) = ", behind))
    inside = False
    for number, line in enumerate(halves["renderer"].split("\n"), 1):
        inside |= line.startswith("#ifdef SHADE_IMPLEMENTATION")
        for name in re.findall(r"\w+", line) if inside else []:
            if name in tools:
                print(f"{number}: the renderer names {name} of the tools")


main()
