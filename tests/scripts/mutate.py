"""mutate.py header seed count folder [lines] - writes mutants of a header, one change each.
mutate.py --check header entries - are the lines of mutation.txt still in the header?

folder/N.h      the mutant       folder/N.diff   its section (>>name), its line before and after
folder/N.where  "public" or "implementation", and the section (>>name) of the change

Changed are the bodies of functions, as many places of each kind: comparisons, constants, signs and
arithmetic, && || and !, bit operations, statements taken out.  Comments, strings, preprocessor
lines, assertions, types and the sizes of arrays stay as they are.  lines: a file of "first count",
as a diff has them; then only functions that have one of these lines are changed."""
import os
import random
import re
import sys

TOKEN = re.compile(r"""
    (?P<skip>/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|^[ ]*\#(?:[^\n]*\\\n)*[^\n]*)
  | (?P<number>0[xX][0-9a-fA-F]+[uUlL]*|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?[fFuUlL]*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<op><<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||\+\+|--|->|[-+*/%&|^]=|[-+*/%&|^!~<>=?:;,(){}\[\].])
""", re.X | re.S | re.M)

SWAPS = {
    "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"], "+": ["-"], "-": ["+"],
    "*": ["/"], "/": ["*"], "+=": ["-=", "="], "-=": ["+=", "="], "*=": ["="], "|=": ["=", "&="],
    "&=": ["=", "|="], "&": ["|"], "|": ["&"], "^": ["|"], "<<": [">>"], ">>": ["<<"],
    "++": ["--"], "--": ["++"], "%": ["/"], "!": [""], "~": [""],
}
KINDS = dict([(o, "comparison") for o in "< <= > >= == !=".split()] +
             [(o, "sign") for o in "+ - * / += -= *= ++ -- %".split()] +
             [(o, "logic") for o in "&& || !".split()])      # the rest: bits
TYPES = set("float double int unsigned char long void size_t uint8_t uint16_t uint32_t uint64_t "
            "int32_t int64_t const static".split())
VALUES = set("number word ) ]".split())     # what a binary operator may follow


def tokens_of(text):
    for m in TOKEN.finditer(text):
        if m.lastgroup != "skip":
            yield m.lastgroup, m.group(), m.start()


def is_type(word):
    return word in TYPES or word == "SHADE_RESTRICT" or word in NAMED_TYPES


def bodies(tokens):
    """Marks tokens inside function bodies; a body's brace follows a closing parenthesis."""
    depth, body, last, marks = 0, None, "", []
    for kind, text, _ in tokens:
        if text == "{":
            if body is None and last == ")":
                body = depth
            depth += 1
        marks.append(body is not None)
        if text == "}":
            depth -= 1
            if body == depth:
                body = None
        last = text
    return marks


def number_variants(text):
    suffix = re.search(r"[uUlLfF]*$", text).group() if not text.startswith("0x") else \
        re.search(r"[uUlL]*$", text).group()
    digits = text[:len(text) - len(suffix)]
    if text.lower().startswith("0x"):
        return ["0x%X%s" % (int(digits, 16) ^ 1 << random.randrange(4), suffix)]
    if re.search(r"[.eEfF]", text):
        value = float(digits)
        number = lambda v: repr(v) if re.search(r"[.e]", repr(v)) else repr(v) + ".0"
        if not value:
            return ["1.0" + suffix]
        return [number(value * 2) + suffix, number(value / 2) + suffix]
    value = int(digits)
    return ["%d%s" % (value + 1, suffix)] + (["%d%s" % (value - 1, suffix)] if value else [])


def sites(text):
    """All changes: (kind, start, end, replacement)."""
    tokens = list(tokens_of(text))
    marks = bodies(tokens)
    found, statement, declares, sized = [], 0, False, False
    parens, braces, of_value = 0, [], 0
    for i, (kind, word, at) in enumerate(tokens):
        before = tokens[i - 1] if i else ("", "", 0)
        if parens == 0 and (before[1] in ("{", ";") or before[1] == "}" and not of_value):
            statement, declares, sized = i, is_type(word), False
        if word == "{":                         # of an initializer, or of a block
            braces.append(int(before[1] == "=" or parens > 0))
            parens += braces[-1]
        elif word == "}" and braces:
            of_value = braces.pop()
            parens -= of_value
        parens += {"(": 1, ")": -1}.get(word, 0)
        if not marks[i] or tokens[statement][1] in ("SHADE_ASSERT", "typedef", "struct", "case"):
            continue
        if word == "=":
            sized = True
        if word == "," and parens == 0:
            sized = False
        line_start = text.rfind("\n", 0, at) + 1
        if "SHADE_ASSERT" in text[line_start:text.find("\n", at)]:
            continue
        if kind == "number":
            # sizes of arrays: their slack is nobody's business
            if not (declares and not sized and parens == 0):
                for v in number_variants(word):
                    found.append(("constant", at, at + len(word), v))
        elif kind == "op" and word in SWAPS:
            binary = before[0] in VALUES or before[1] in VALUES
            if word in "*&" and (not binary or is_type(before[1])):
                continue                        # a pointer
            if word in ("+", "-") and not binary:
                if word == "-":
                    found.append(("sign", at, at + 1, ""))
                continue
            if word == "*" and declares and not sized:
                continue
            for v in SWAPS[word]:
                found.append((KINDS.get(word, "bits"), at, at + len(word), v))
        elif word == ";" and parens == 0 and not declares and i > statement:
            first = tokens[statement][1]
            begin = tokens[statement][2]
            if first in ("return", "else", "do", "while", "for", "switch", "default", "goto"):
                continue
            if first == "if":                   # what it guards, if that is one statement
                level, j = 0, statement + 1
                while j < i:
                    level += {"(": 1, ")": -1}.get(tokens[j][1], 0)
                    j += 1
                    if level == 0:
                        break
                if tokens[j][1] in ("if", "for", "else", "while"):
                    continue
                begin = tokens[j][2]
            if "\n" not in text[begin:at]:
                found.append(("statement", begin, at, ""))
    return found


def functions_with(text, ranges):
    """Whether an offset is in a function, from its first word to its brace, that has one of the
    lines."""
    tokens, changed, spans, start = list(tokens_of(text)), set(), [], None
    number = lambda at: text.count("\n", 0, at) + 1
    for first, n in ranges:
        changed.update(range(first, first + n))
    marks = bodies(tokens) + [False]
    for i, (_, word, at) in enumerate(tokens):
        start = at if start is None else start
        if marks[i] and not marks[i + 1]:
            if any(n in changed for n in range(number(start), number(at) + 1)):
                spans.append((start, at))
            start = None
        elif not marks[i] and word in ";}":
            start = None
    return lambda at: any(first <= at < last for first, last in spans)


def check_entries(header, entries):
    """Sections in the header's order, every line before in its section, no entry twice."""
    text, problems, seen = open(header).read(), [], set()
    tight = lambda line: "".join(line.split())
    banners = [(m.start(), m.group(1)) for m in re.finditer(r"^/\*-+ >>(\w+)", text, re.M)]
    ends = [at for at, _ in banners[1:]] + [len(text)]
    order = [name for _, name in banners]
    lines = {name: set(map(tight, text[at:end].split("\n")))
             for (at, name), end in zip(banners, ends)}
    section, since, entry = "", 0, []           # entry: its line before, its line after

    def close():
        if not entry:
            return
        name, (before, after) = section, (entry + [""])[:2]
        if before not in lines.get(name, ()):
            problems.append(">>%s has no line  %s" % (name, before))
        if not after or before == after or (name, before, after) in seen:
            problems.append(">>%s has twice, or without a change  %s" % (name, before))
        seen.add((name, before, after))
        entry.clear()

    for line in open(entries).read().split("\n"):
        if line.startswith(">>"):
            close()
            section = line[2:]
            if section not in order[since:]:
                problems.append("not in the header, or not in its order  " + line)
            else:
                since = order.index(section) + 1
        elif line.startswith("-"):
            close()
            entry.append(tight(line[1:]))
        elif line.startswith("+"):
            entry.append(tight(line[1:]))
        elif line.startswith(" ") and entry:
            entry[-1] += tight(line)
    close()
    print("\n".join(entries + ": " + p for p in problems) or "%d entries" % len(seen))
    return bool(problems)


if sys.argv[1] == "--check":
    sys.exit(check_entries(sys.argv[2], sys.argv[3]))
header, seed, count, folder = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
text = open(header).read()
NAMED_TYPES = set(re.findall(r"\}\s*(shade_\w+);", text)) | set(
    re.findall(r"typedef\s+(?:struct|enum|union)\s+\w+\s+(shade_\w+);", text))
random.seed(seed)
all_sites = sites(text)
if len(sys.argv) > 5:
    ranges = [tuple(map(int, line.split())) for line in open(sys.argv[5])]
    wanted = functions_with(text, ranges)
    all_sites = [site for site in all_sites if wanted(site[1])]
private = text.index("#ifdef SHADE_IMPLEMENTATION")
random.shuffle(all_sites)
kinds = {}
for site in all_sites:
    kinds.setdefault(site[0], []).append(site)
print("%d possible: %s" % (len(all_sites), ", ".join(
    "%d of %s" % (len(kinds[k]), k) for k in sorted(kinds))))
chosen = []                                     # all kinds in turn
while len(chosen) < min(count, len(all_sites)):
    chosen += [kinds[k].pop() for k in sorted(kinds) if kinds[k]]
for n, (kind, start, end, new) in enumerate(chosen[:count]):
    mutant = text[:start] + new + text[end:]
    first, last = text.rfind("\n", 0, start) + 1, text.find("\n", end)
    banner = re.findall(r"^/\*-+ >>(\w+)", text[:start], re.M)
    name = os.path.join(folder, str(n))
    open(name + ".h", "w").write(mutant)
    open(name + ".diff", "w").write(">>%s\n- %s\n+ %s\n" % (
        banner[-1] if banner else "about", text[first:last].strip(), mutant[first:last + len(new) - (end - start)].strip()))
    open(name + ".where", "w").write("%s %s\n" % (
        "implementation" if start > private else "public", banner[-1] if banner else "about"))
