"""Points for answers, and sentences for wrong ones.

A case has 100 random inputs, and its points are shared by them.  For wrong answers the judge looks
for a known mistake, or for two at a time, that gives just these numbers.  A known mistake is a
change of the text of the right answer.
"""
import importlib
import inspect
import math
import re
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Callable, NamedTuple

from . import tools
from .student import CALLS, flat

TRIES = 100
LOOSE = 10  # tolerances: wrong answers may be large, and rounded more


class Case(NamedTuple):
    """Inputs of one kind, and what to look at where an answer is no known mistake."""
    points: int
    name: str
    make: Callable
    hint: str
    part: slice = slice(None)  # of the answer, what counts


class Task:
    """A task by its name: cases, right answers, mistakes."""

    def __init__(self, name):
        self.name, self.module = name, importlib.import_module(f"judge.{name}")
        self.names = parts(self.module.INPUTS)
        self.outputs = sum(count for _, count in parts(self.module.OUTPUTS))
        self.sent = getattr(self.module, "SENT", sum(count for _, count in self.names))
        self.cases, self.mistakes = self.module.CASES, self.module.MISTAKES
        self.source = "\n\n".join(inspect.getsource(f) for f in self.module.FUNCTIONS)

    def inputs(self, case, seed):
        """Returns the inputs of a case, as a C float has them."""
        draw = tools.Draw(f"{self.name} {case.name} {seed}")
        return [[tools.single(x) for x in case.make(draw)] for _ in range(TRIES)]

    def answerer(self, *mistakes):
        """Returns a function that gives the right answer to inputs, or that of mistakes; None where
        a change finds no text to change."""
        source = self.source
        for _, old, new, _ in mistakes:
            if old not in source:
                return None
            source = source.replace(old, new)
        space = {**vars(tools), "math": math}
        exec(compile(source, self.name, "exec"), space)  # pylint: disable=exec-used

        def answer(inputs):
            try:
                numbers = flat(CALLS[self.name](SimpleNamespace(**space), inputs))
                return [x if abs(x) < 1e38 else math.inf for x in numbers]  # as floats end
            except (ArithmeticError, ValueError, TypeError):
                return None
        return answer

    def compared(self, inputs, numbers):
        """Returns the numbers of an answer that count; None where there is no answer."""
        if numbers is None or not hasattr(self.module, "compared"):
            return numbers
        return self.module.compared(inputs, numbers)

    def near(self, got, want, part=slice(None), times=1):
        """Tells whether parts of two answers are the same within some times the tolerance.  No
        answer, a NaN and an infinity are the same mistake."""
        if got is None or want is None:
            other = want if got is None else got
            return other is None or not all(map(math.isfinite, other[part]))
        most = times * self.module.TOLERANCE
        return all(abs(g - w) <= most * max(1, abs(w)) if math.isfinite(g) and math.isfinite(w)
                   else math.isfinite(g) == math.isfinite(w) for g, w in zip(got[part], want[part]))


def parts(text):
    """Returns names with their numbers of floats: "N3 n1" is (N, 3), (n, 1)."""
    return [(name, int(count)) for name, count in re.findall(r"(\S*?)(\d+)(?: |$)", text)]


def show(numbers):
    """Returns numbers as text, several in brackets."""
    texts = [f"{x:.6g}" for x in numbers]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def show_named(names, numbers):
    """Returns named numbers as text; names that are empty are left out."""
    said, at = [], 0
    for name, count in names:
        if at < len(numbers):
            said.append((f"{name} = " if name else "") + show(numbers[at:at + count]))
        at += count
    return ", ".join(said)


@dataclass
class Result:
    """What became of a case."""
    case: Case
    score: float = 0
    says: str = ""
    asked: list = field(default_factory=list)  # inputs, answer, right answer, the part that counts


class Judge:
    """Asks a student for answers to all cases and gives points for them."""

    def __init__(self, task, seed):
        self.task, self.seed, self.results = task, seed, []
        self.right, self.wrong, self.told = task.answerer(), {}, {}

    def judge(self, ask):
        """Returns the results of all cases; ask takes inputs and returns answers and a sentence."""
        ends = []
        for case in self.task.cases:
            inputs = self.task.inputs(case, self.seed)
            answers, end = ask([v[:self.task.sent] for v in inputs])
            result, compared = Result(case), self.task.compared
            for v, got in zip(inputs, answers):
                result.asked.append((v, compared(v, got), compared(v, self.right(v)), case.part))
            right = sum(self.good(*one) for one in result.asked)
            result.score = math.floor(100 * case.points * right / TRIES) / 100
            self.results.append(result)
            ends.append(end)
        known = self.known()
        for result, end in zip(self.results, ends):
            result.says = self.says(result, end, known)
        return self.results

    def good(self, _, got, want, part):
        """Tells whether an answer is right."""
        return got is not None and self.task.near(got, want, part)

    def gives(self, asked, *mistakes):
        """Tells whether mistakes give all of these answers, and not just right ones."""
        key = tuple(m[0] for m in mistakes)
        if key not in self.wrong:
            self.wrong[key] = self.task.answerer(*mistakes)
        wrong, differs = self.wrong[key], False
        if not wrong or not asked:
            return False
        for v, got, want, part in asked:
            numbers = self.task.compared(v, wrong(v))
            if not self.task.near(got, numbers, part, LOOSE):
                return False
            differs = differs or not self.task.near(numbers, want, part)
        return differs

    def known(self):
        """Returns the mistakes that explain all answers; where none does, two that do together."""
        asked = [one for result in self.results for one in result.asked]
        asked.sort(key=lambda one: self.good(*one))  # wrong ones tell soonest
        found = [m for m in self.task.mistakes if self.gives(asked, m)]
        if found or self.alike(asked) or all(self.good(*one) for one in asked):
            return found
        for k, first in enumerate(self.task.mistakes):
            for second in self.task.mistakes[k + 1:]:
                if self.gives(asked, first, second) or self.gives(asked, second, first):
                    return [first, second]
        return []

    def alike(self, asked):
        """Tells whether all answers are the same, whatever the input."""
        return all(self.task.near(one[1], asked[0][1]) for one in asked)

    def says(self, result, end, known):
        """Returns why a case has lost points, or nothing."""
        case, asked = result.case, result.asked
        wrong = [one for one in asked if not self.good(*one)]
        lost = TRIES - len(asked)
        if not wrong and not lost:
            return ""
        if lost and not end:
            return "Not run: the program took too long before."
        text = hint = ""
        if lost:
            v = self.task.inputs(case, self.seed)[len(asked)]
            text = f"The program {end}, with {self.shown(v)}. "
        if wrong:
            v, got, want, _ = min(wrong, key=lambda one: self.count(one[0]))
            text += f"Wrong for {len(wrong)} of {len(asked)} inputs. For {self.shown(v)} "
            if got is None:
                raised = "raises" if lost else end
                text += f"yours {raised}{'' if raised.endswith('?') else '.'} "
            else:
                text += self.differ(case, got, want)
            hint = self.why(case, asked, got, known)
            text += hint
        first = self.first(result, hint or end)
        if first is not result:
            text = (f"Wrong for {lost + len(wrong)} of {TRIES} inputs. "
                    f"See the case '{first.case.name}' first.")
        return text.strip()

    def first(self, result, reason):
        """Returns the result to look at first: that of a case which is a part of this one and has
        lost points, or else the first one that has lost them for the same reason."""
        bases = self.results[:getattr(self.task.module, "BASES", 0)]
        for base in bases[:self.results.index(result)]:
            if base.score < base.case.points:
                return base
        return self.told.setdefault(reason, result)

    def differ(self, case, got, want):
        """Returns both answers as text, or of 64 pixels the first that differs."""
        if len(got) == 64:
            k = next(k for k in range(64) if got[k] != want[k])
            return f"and the pixel ({k % 8}, {k // 8}) yours is {got[k]:g}, right is {want[k]:g}. "
        return f"yours is {show(got[case.part])}, right is {show(want[case.part])}. "

    def shown(self, v):
        """Returns inputs as text, without those that mean nothing."""
        return show_named(self.task.names, v[:self.count(v)])

    def count(self, v):
        """Returns how many of the inputs mean something."""
        return self.task.module.shown(v) if hasattr(self.task.module, "shown") else len(v)

    def why(self, case, asked, got, known):
        """Returns the sentence of a known mistake, or what the numbers tell, or the hint."""
        if known:
            return " ".join(dict.fromkeys(m[3] for m in known))
        if got is None:
            return ""
        alike = self.alike(asked)
        if not alike:
            for mistake in self.task.mistakes:
                if self.gives(asked, mistake) and not self.spoils(mistake):
                    return f"One mistake that fits this case: {mistake[3]}"
        if any(map(math.isnan, got)):
            return "A NaN comes from 0 / 0, or from a root or a power of a negative number."
        if any(map(math.isinf, got)):
            return "An infinity comes from a division by 0."
        if alike:
            return f"Your answer is the same for every input. {case.hint}"
        return self.term(asked) or f"{self.common(asked)}{case.hint}"

    def spoils(self, mistake):
        """Tells whether a mistake would be seen in a case that is all right."""
        wrong = self.wrong[(mistake[0],)]
        return any(not self.task.near(self.task.compared(v, wrong(v)), want, part, LOOSE)
                   for result in self.results if all(self.good(*one) for one in result.asked)
                   for v, _, want, part in result.asked)

    def common(self, asked):
        """Returns what all answers of a case have in common with right ones, or nothing: a factor,
        a number that is added, a power, directions or parts that are right."""
        pairs = [(got[part], want[part]) for _, got, want, part in asked if got is not None]
        size = len(pairs[0][1])
        if len(pairs) < len(asked) or size > 9:
            return ""
        near = self.task.near
        g, w = max(((g[k], w[k]) for g, w in pairs for k in range(size)), key=lambda x: abs(x[1]))
        factor, more = g / w if w else 0, pairs[0][0][0] - pairs[0][1][0]
        if factor and all(near(g, tools.scale(factor, w), times=LOOSE) for g, w in pairs):
            return f"Each of your answers is {factor:.4g} times the right one. "
        if all(near(g, [x + more for x in w], times=LOOSE) for g, w in pairs):
            return f"Each of your answers is the right one and {more:.4g}. "
        if all(x == int(x) for g, _ in pairs for x in g) and any(
                x not in (0, 1) for g, _ in pairs for x in g):
            return "Your answers are whole numbers: an int or a // cuts them. "
        if size == 1 and min(g[0] for g, _ in pairs) >= 0 < min(w[0] for _, w in pairs):
            g, w = min(pairs, key=lambda pair: abs(pair[1][0] - 0.5))
            power = math.log(max(g[0], 1e-30)) / (math.log(w[0]) or 1)
            if all(near(g, [w[0] ** power], times=LOOSE) for g, w in pairs):
                return f"Each of your answers is the right one to the power {power:.3g}. "
        if size == 3 and all(near(tools.unit(g), tools.unit(w), times=LOOSE) for g, w in pairs):
            return "Your directions are right, but their lengths are not. "
        right = [k for k in range(size) if all(near(g[k:k + 1], w[k:k + 1]) for g, w in pairs)]
        names = getattr(self.task.module, "PARTS", "xyz")
        if right and size == len(names):
            wrong = [names[k] for k in range(size) if k not in right]
            return f"All is right but {' and '.join(wrong)}. "
        return ""

    def term(self, asked):
        """Returns a sentence of the term that is wrong, where the task has terms: all that is off
        lies along it."""
        terms = getattr(self.task.module, "terms", None)
        if not terms or any(got is None for _, got, _, _ in asked):
            return ""
        off = [(tools.sub(got, want), terms(self.right, v)) for v, got, want, _ in asked]
        for k, (_, says) in enumerate(off[0][1]):
            if all(1e-3 < tools.length(along[k][0]) and tools.length(tools.cross(
                    by, along[k][0])) < 1e-3 * tools.length(along[k][0]) for by, along in off):
                return says
        return ""
