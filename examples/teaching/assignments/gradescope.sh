#!/bin/sh
# gradescope.sh - packs the grader of a task for Gradescope: "Configure Autograder" takes the zip.
#     sh examples/teaching/assignments/gradescope.sh 01 4711 lambert.zip
# The second argument is the seed of the class, which makes its inputs: a long number that is nobody's
# birthday.  Students hand in one file, a .c or a .py.
[ $# -eq 3 ] || { echo "usage: gradescope.sh TASK SEED OUT.zip" >&2; exit 2; }
task=$1 seed=$2
case $3 in /*) zip=$3 ;; *) zip=$PWD/$3 ;; esac
case $seed in *[!0-9]* | '') echo "gradescope.sh: the seed $seed is not a number" >&2; exit 2 ;; esac
cd "$(dirname "$0")/../../.." || exit 1
A=examples/teaching/assignments
for file in "$A/$task" "$A/$task"_* "$A/0$task"_*; do [ -d "$file" ] && break; done
task=${file##*/}
[ -f "$A/judge/$task.py" ] || { echo "gradescope.sh: there is no task $1" >&2; exit 2; }
command -v zip >/dev/null || { echo "gradescope.sh: there is no zip (apt install zip)" >&2; exit 1; }
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM

mkdir -p "$T/$A"
cp LICENSE "$T"
cp -R $A/grade.py $A/vectors.h $A/judge "$T/$A"
echo "$seed" >"$T/seed"
printf '#!/bin/sh\napt-get update && apt-get install -y gcc libc6-dev python3 bubblewrap\n' >"$T/setup.sh"
cat >"$T/run_autograder" <<END
#!/bin/sh
# run_autograder - judges the one file of /autograder/submission.  The grader's folders are closed to
# the user nobody, who runs the compiler and the student's code.
root=\${AUTOGRADER:-/autograder}
mkdir -p "\$root/results" && chmod 700 "\$root/source" "\$root/results" && cd "\$root/source" || exit 1
chmod 600 seed && python3 $A/grade.py $task "\$root/submission" --seed-file seed \\
    --json "\$root/results/results.json"
[ -s "\$root/results/results.json" ]
END
chmod +x "$T/setup.sh" "$T/run_autograder"
rm -f "$zip"
cd "$T" && zip -qr "$zip" . -x '*__pycache__*'
