#!/bin/sh
# gradescope.sh - packs the grader of a task for Gradescope: "Configure Autograder" takes the zip.
#     sh examples/teaching/assignments/gradescope.sh 01_lambert 4711 lambert.zip
# The second argument is the seed of the class, which makes its inputs.  Students hand in one file, a .c
# or, where the task has a starter.py, a .py.
[ $# -eq 3 ] || { echo "usage: gradescope.sh TASK SEED OUT.zip" >&2; exit 2; }
task=$1 seed=$2
case $3 in /*) zip=$3 ;; *) zip=$PWD/$3 ;; esac
case $seed in *[!0-9]* | '') echo "gradescope.sh: the seed $seed is not a number" >&2; exit 2 ;; esac
cd "$(dirname "$0")/../../.." || exit 1
A=examples/teaching/assignments
[ -f "$A/$task/grade.c" ] || { echo "gradescope.sh: there is no task $task" >&2; exit 2; }
command -v zip >/dev/null || { echo "gradescope.sh: there is no zip (apt install zip)" >&2; exit 1; }
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM

mkdir -p "$T/$A/$task"
cp shade.h LICENSE "$T"
cp $A/grade.h $A/grade.py "$T/$A"
cp "$A/$task/"[gs]* "$T/$A/$task"
printf '#!/bin/sh\napt-get update && apt-get install -y gcc libc6-dev python3\n' >"$T/setup.sh"
sed -e '1,/^# ---- run_autograder/d' -e "s/@TASK@/$task/; s/@SEED@/$seed/" "$A/gradescope.sh" >"$T/run_autograder"
chmod +x "$T/setup.sh" "$T/run_autograder"
rm -f "$zip"
cd "$T" && zip -qr "$zip" .
exit
# ---- run_autograder
#!/bin/sh
# run_autograder - judges the one file of /autograder/submission.
root=${AUTOGRADER:-/autograder} task=@TASK@ seed=@SEED@
json=$root/results/results.json
A=examples/teaching/assignments
mkdir -p "$root/results"
cd "$root/source" || exit 1

# A result of no points that says why.
refuse() {
    { printf '{ "score": 0, "output": "'
      printf '%s\n' "$*" | sed 's/\\/\\\\/g; s/"/\\"/g; s/	/    /g' | awk '{ printf "%s\\n", $0 }'
      printf '" }\n'; } >"$json"
    exit 0
}
grader() { cc -O1 -I. "$A/$task/grade.c" "$1" -lm -o "$root/grade" 2>&1; }

set -- "$root"/submission/*.c "$root"/submission/*.py
for answer; do [ -f "$answer" ] && break; done
[ -f "$answer" ] || refuse "There is no .c and no .py file in what you handed in."
case $answer in
*.py)
    [ -f "$A/$task/starter.py" ] || refuse "This task is one in C: hand in a .c file."
    said=$(grader "$A/$task/starter.c") && "$root/grade" --seed "$seed" --vectors >"$root/vectors.json"
    timeout 120 python3 "$A/grade.py" "$answer" "$root/vectors.json" --json "$json" || [ $? != 124 ] ||
        refuse "Your function did not come back within two minutes."
    ;;
*)
    said=$(grader "$answer") || refuse "Your file does not compile: $said"
    timeout 120 "$root/grade" --seed "$seed" --json "$json"
    ;;
esac
