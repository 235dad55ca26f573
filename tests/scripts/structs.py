"""structs.py [cc] - the public structs of shade.h: a line a field, "struct field offset size",
as the compiler has them.  The packages' twins of these structs are held to it, name by name."""
import os
import re
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))


def fields(header):
    """Each struct's name and those of its fields."""
    text = re.sub(r"/\*.*?\*/", "", header.split("#ifdef SHADE_IMPLEMENTATION")[0], flags=re.S)
    for name, body in re.findall(r"typedef struct (shade_\w+) \{(.*?)\} \1;", text, re.S):
        yield name, [re.search(r"(\w+)\s*(?:\[[^]]*\]\s*)*$", one).group(1)
                     for part in body.split(";") if part.strip() for one in part.split(",")]


with open(os.path.join(TOP, "shade.h")) as file:
    structs = list(fields(file.read()))
lines = ['    printf("%s %s %%d %%d\\n", (int)offsetof(%s, %s), (int)sizeof(((%s *)0)->%s));\n'
         % (s, f, s, f, s, f) for s, names in structs for f in names]
with tempfile.TemporaryDirectory() as folder:
    source, program = os.path.join(folder, "structs.c"), os.path.join(folder, "structs")
    with open(source, "w") as file:
        file.write('#include "shade.h"\n#include <stdio.h>\nint main(void)\n{\n%s    return 0;\n}\n'
                   % "".join(lines))
    subprocess.run([*(sys.argv[1:] or ["cc"]), "-I" + TOP, source, "-o", program], check=True)
    subprocess.run([program], check=True)
