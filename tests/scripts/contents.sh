#!/bin/sh
# contents.sh [--update] - the line numbers in the contents table of shade.h are those of the
# banners; --update writes them.
cd "$(dirname "$0")/../.." || exit 1
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
awk 'NR == FNR { if (/^\/\*-+ >>/) line[$2] = FNR; next }
    />>contents$/ { inside = 1 }
    !NF { inside = 0 }
    inside {
        rest = $0; done = ""
        while (match(rest, />>[a-z]+ +[0-9]+/)) {
            entry = substr(rest, RSTART, RLENGTH); tag = entry; sub(/ .*/, "", tag)
            done = done substr(rest, 1, RSTART - 1) sprintf("%s%" (RLENGTH - length(tag)) "d", tag, line[tag])
            rest = substr(rest, RSTART + RLENGTH)
        }
        $0 = done rest
    }
    { print }' shade.h shade.h >"$T/shade.h" || exit 1
if [ "$1" = --update ]; then cat "$T/shade.h" >shade.h; else diff shade.h "$T/shade.h"; fi
