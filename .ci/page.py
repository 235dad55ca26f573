"""page.py python|node version - the README of a package as its registry shows it: links lead to the tree of
this version, and what of CHANGELOG.md is about the package stands at its end."""
import posixpath
import re
import sys
from pathlib import Path

WORDS = {"python": ("Python and Node", "`pip", "pyrender"), "node": ("Node", "`npm")}
package, version = sys.argv[1:]
folder = f"examples/packages/{package}"
address = re.search(r'^Repository = "(.*)"', Path("examples/packages/python/pyproject.toml").read_text("utf-8"),
                    re.M)[1]


def absolute(found):
    """A link or a picture, as it is from anywhere."""
    picture, text, path = found.groups()
    kind = "raw" if picture else "blob"
    return f"{picture}[{text}]({address}/{kind}/v{version}/{posixpath.normpath(posixpath.join(folder, path))})"


page = re.sub(r"(!?)\[([^\]]*)\]\((?!#|[a-z]+:)([^)]*)\)", absolute,
              Path(folder, "README.md").read_text("utf-8"))
short = version.rpartition(".")[0]
news = re.search(rf"^## {short}, .*\n\n((?:[* ] .*\n)*)", Path("CHANGELOG.md").read_text("utf-8"), re.M)[1]
bullets = [one for one in re.findall(r"^\* .*\n(?:  .*\n)*", news, re.M) if any(word in one for word in WORDS[package])]
sys.stdout.write(f"{page}\n## New in {short}\n\n{''.join(bullets)}")
