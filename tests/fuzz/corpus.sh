#!/bin/sh
# corpus.sh - the inputs of fuzz targets: tests/fuzz/corpus/TARGET.txt has one a line, in base64.
#     sh tests/fuzz/corpus.sh list TARGET                number, bytes and checksum of each input
#     sh tests/fuzz/corpus.sh add TARGET INPUT ...       adds files that are not among them
#     sh tests/fuzz/corpus.sh unpack TARGET FOLDER       writes each as a file, as fuzzers read them
usage() { sed -n '2,5s/^# *//p' "$0" >&2; exit 2; }
[ $# -ge 2 ] || usage
does=$1 target=$2 file=$(dirname "$0")/corpus/$2.txt
shift 2
unpack() {
    n=0
    while read -r line; do
        printf %s "$line" | base64 -d >"$1/$(printf '%03d' $n)" || exit 1
        n=$((n + 1))
    done <"$file"
}
case $does in
list)
    T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT && unpack "$T" && cd "$T" && cksum ./* |
        awk '{ print substr($3, 3), $2, $1 }'
    ;;
add)
    for input; do
        line=$(base64 <"$input" | tr -d '\n') || exit 1
        grep -qxF -e "$line" "$file" 2>/dev/null || printf '%s\n' "$line" >>"$file"
    done
    ;;
unpack) [ $# -eq 1 ] && mkdir -p "$1" && rm -f "$1"/[0-9]* && unpack "$1" ;;
*) usage ;;
esac
