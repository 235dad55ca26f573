#!/bin/sh
# corpus.sh - the inputs of fuzz targets: tests/fuzz/corpus.txt has one a line, its target and the
# input in base64.
#     sh tests/fuzz/corpus.sh list TARGET                number, bytes and checksum of each input
#     sh tests/fuzz/corpus.sh add TARGET INPUT ...       adds files that are not among them
#     sh tests/fuzz/corpus.sh unpack TARGET FOLDER       writes each as a file, as fuzzers read them
usage() { sed -n '2,6s/^# *//p' "$0" >&2; exit 2; }
[ $# -ge 2 ] || usage
does=$1 target=$2 file=$(dirname "$0")/corpus.txt
shift 2
unpack() {
    n=0
    while read -r of line; do
        [ "$of" = "$target" ] || continue
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
        grep -qxF -e "$target $line" "$file" || printf '%s %s\n' "$target" "$line" >>"$file"
    done
    LC_ALL=C sort -s -k1,1 -o "$file" "$file"
    ;;
unpack) [ $# -eq 1 ] && mkdir -p "$1" && rm -f "$1"/[0-9]* && unpack "$1" ;;
*) usage ;;
esac
