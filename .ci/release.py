"""release.py page python|node version - the README of a package as its registry shows it: links lead to
the tree of this version, and what of CHANGELOG.md is about the package stands at its end.

release.py sbom folder version time contained - the files of a release as an SPDX 2.3 document.  contained
has a line for what of others some of them hold: pattern|name|version|licence|address."""
import hashlib
import json
import posixpath
import re
import sys
from datetime import datetime, timezone
from fnmatch import fnmatch
from pathlib import Path

# What a package is called in the changes; the page of one leaves out what is of the other alone.
LANGUAGES = {"python": r"Python|pyrender", "node": r"Node|JavaScript|TypeScript"}


def page(package, version):
    """Writes the page of a package."""
    folder = f"examples/packages/{package}"
    address = re.search(r'^Repository = "(.*)"', Path("examples/packages/python/pyproject.toml").read_text("utf-8"),
                        re.M)[1]

    def absolute(found):
        """A link or a picture, as it is from anywhere."""
        picture, text, path = found.groups()
        kind = "raw" if picture else "blob"
        return f"{picture}[{text}]({address}/{kind}/v{version}/{posixpath.normpath(posixpath.join(folder, path))})"

    text = re.sub(r"(!?)\[([^\]]*)\]\((?!#|[a-z]+:)([^)]*)\)", absolute,
                  Path(folder, "README.md").read_text("utf-8"))
    short = version.rpartition(".")[0]
    news = re.search(rf"^## {short}, [^\n]*\n(.*?)(?=^## )", Path("CHANGELOG.md").read_text("utf-8"), re.M | re.S)[1]
    groups = re.findall(r"^\*\*(?:Model files|Packages)\b.*\*\*\n\n((?:[* ] .*\n)*)", news, re.M)
    own, other = LANGUAGES[package], LANGUAGES["node" if package == "python" else "python"]
    bullets = [one for one in re.findall(r"^\* .*\n(?:  .*\n)*", "".join(groups), re.M)
               if re.search(own, one) or not re.search(other, one)]
    sys.stdout.write(f"{text}\n## New in {short}\n\n{''.join(bullets)}")


def sbom(folder, version, time, contained):
    """Writes the document of a release."""
    names = sorted(p.name for p in Path(folder).iterdir()
                   if p.is_file() and p.name != "SHA256SUMS" and not p.name.endswith(".spdx.json"))
    sums = {name: hashlib.sha256(Path(folder, name).read_bytes()).hexdigest() for name in names}
    whole = hashlib.sha256("".join(sums[name] for name in names).encode()).hexdigest()

    def package(name, extra):
        """What all packages say alike."""
        return {"name": name, "versionInfo": version, "licenseConcluded": "MIT OR Unlicense",
                "licenseDeclared": "MIT OR Unlicense", "copyrightText": "NOASSERTION",
                "downloadLocation": "NOASSERTION", "filesAnalyzed": False, **extra}

    packages = [package("shade-h", {"SPDXID": "SPDXRef-shade-h"})]
    packages += [package(name, {"SPDXID": f"SPDXRef-file-{i}", "packageFileName": name,
                                "checksums": [{"algorithm": "SHA256", "checksumValue": sums[name]}]})
                 for i, name in enumerate(names)]
    needed = {"SPDXID": "SPDXRef-numpy", "name": "numpy", "versionInfo": ">=1.21",
              "downloadLocation": "https://pypi.org/project/numpy", "filesAnalyzed": False,
              "licenseConcluded": "NOASSERTION", "licenseDeclared": "BSD-3-Clause",
              "copyrightText": "NOASSERTION"}
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-shade-h")]
    relations += [(f"SPDXRef-file-{i}", "PACKAGE_OF", "SPDXRef-shade-h") for i in range(len(names))]
    relations += [(f"SPDXRef-file-{i}", "DEPENDS_ON", "SPDXRef-numpy")
                  for i, name in enumerate(names) if name.startswith("shade_h-")]
    others = []
    for line in sorted(set(Path(contained).read_text("utf-8").splitlines())):
        pattern, name, of, licence, address = line.split("|")
        holders = [i for i, file in enumerate(names) if fnmatch(file, pattern)]
        one = {"SPDXID": f"SPDXRef-{name}", "name": name, "versionInfo": of, "downloadLocation": address,
               "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence,
               "copyrightText": "NOASSERTION"}
        others += [one] if holders and one not in others else []
        relations += [(f"SPDXRef-file-{i}", "CONTAINS", one["SPDXID"]) for i in holders]
    json.dump({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"shade-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/shade-{version}-{whole}",
        "creationInfo": {"created": datetime.fromtimestamp(int(time), timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Tool: release.py"]},
        "packages": [*packages, needed, *others],
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b}
                          for a, kind, b in relations]}, sys.stdout, indent=1)
    print()


{"page": page, "sbom": sbom}[sys.argv[1]](*sys.argv[2:])
