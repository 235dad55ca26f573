# quick.sh - sourced behind tools.sh by tests of what is built: compilers in $T/bin, to be put before
# others, that leave out the sentences of explain and what only makes drawing faster: the same bits,
# compiled in a seventh of the time.
mkdir -p "$T/bin"
compiler() {                    # name, what it is
    printf '#!/bin/sh\nexec %s -DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED -DSHADE_NO_EXPLAIN "$@" -O0\n' \
        "$2" >"$T/bin/$1"
    chmod +x "$T/bin/$1"
}
compiler cc "$(command -v "${CC:-cc}")"
