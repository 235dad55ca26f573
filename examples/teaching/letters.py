"""The letters of the four courses, as the playground has them: playground/math.js."""
import re
from pathlib import Path

COURSES = ("uw", "massey", "shirley", "berkeley")
HERE = Path(__file__).resolve().parent


def letters(course):
    """Returns the letters of a course in TeX, by those of shade.h."""
    text = (HERE / "playground/math.js").read_text(encoding="utf-8")
    table = re.search(rf"^    {course}: \{{(.*?)\}},?$", text, re.M | re.S).group(1)
    return {(key or quoted).replace("\\\\", "\\"): letter.replace("\\\\", "\\") for key, quoted, letter in
            re.findall(r"(?:(\w+)|'((?:[^'\\]|\\.)*)'): '((?:[^'\\]|\\.)*)'", table)}
