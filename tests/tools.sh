# tools.sh - sourced by matrix.sh and compilers.sh: a folder $T of their own, counts, their end.
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
passed=0 failed=0 skipped=0

there() { command -v "$1" >/dev/null 2>&1; }
left_out() { skipped=$((skipped + 1)); echo "left out  $1"; }
fail() {                        # what, file that tells more
    failed=$((failed + 1)); echo "FAIL      $1"; sed 's/^/    /;12q' "$2"
}
finish() {
    echo "$skipped left out"
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}
