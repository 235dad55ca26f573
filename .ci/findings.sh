#!/bin/sh
# findings.sh - runs findings/*.sh, one after the other, and lists those whose behaviour changed.
cd "$(dirname "$0")/.." || exit 1
same=0 changed= untried=
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
trap 'exit 1' INT TERM
for script in findings/*.sh; do
    [ -f "$script" ] || continue
    name=$(basename "$script" .sh)
    sh "$script" >"$log" 2>&1 </dev/null
    case $? in
    0) same=$((same + 1)); echo "same     $name: $(tail -n 1 "$log")" ;;
    77) untried="$untried $name"; echo "untried  $name: $(tail -n 1 "$log")" ;;
    *) changed="$changed $name"; echo "CHANGED  $name"; tail -n 20 "$log" | sed 's/^/    /' ;;
    esac
done
echo "$same as they were; changed:${changed:- none}; not tried:${untried:- none}"
[ -z "$changed" ]
