#!/bin/sh
# version.sh [list] - writes the version of shade.h into every file that .ci/versions.txt names; list prints
# "file version" for each instead.
cd "$(dirname "$0")/.." || exit 1
number=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
V=$((number / 10000)).$((number / 100 % 100)).$((number % 100))
grep -v '^#' .ci/versions.txt | while read -r file text; do
    case $text in ^*) before= ;; *) before='.*' ;; esac
    old=$(sed -n "s#$before$text.*#\1#p" "$file" | head -n 1)
    if [ "$1" = list ]; then echo "$file ${old:-none}"
    elif [ -z "$old" ]; then echo "version.sh: $file has no $text" >&2; exit 1
    else
        new=$(printf '%s' "$text" | sed "s#\\\\(.*\\\\)#$V#; s#\\\\\\.#.#g; s#^\^##")
        was=$(printf '%s' "$text" | sed "s#\\\\(.*\\\\)#$old#; s#^\^##")
        sed "s#$was#$new#" "$file" >"$file.new" && cat "$file.new" >"$file" && rm "$file.new"
    fi
done
