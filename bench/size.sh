#!/bin/sh
# size.sh - seconds to compile shade.h's implementation, its machine code, what programs carry of
# it, and the stack it takes.  CC and BUILD (where to build) may be set.
#
#   size.sh             all of it, as Markdown
#   size.sh bytes       only machine code and what programs carry
#   size.sh check       are these the numbers of bench/README.md, within 3 %?  They are those of
#                       gcc 12 on x86-64: elsewhere nothing is compared.
set -e
cd "$(dirname "$0")/.."
cc=${CC:-cc}
check() {
    if [ "$(uname -m)" != x86_64 ] || ! $cc --version | head -n 1 | grep -qE '^(gcc|cc).* 12\.'; then
        echo "left out: the sizes are those of gcc 12 on x86-64"
        echo "0 passed, 0 failed"
        exit
    fi
    T=$(mktemp -d)
    trap 'rm -rf "$T"' EXIT
    BUILD=$T sh bench/size.sh bytes >"$T/now"

    # a row's name is what stands before its first number
    awk -F' *\\| *' '
        function near(a, b) { return a - b <= 0.03 * b + 0.05 && b - a <= 0.03 * b + 0.05 }
        /^\|[ -]/ && NF > 5 {
            for (first = 2; first < NF && $first !~ /^[0-9.]+$/; first++) ;
            name = $2
            if (first >= NF) next
            if (FILENAME ~ /now$/) {
                rows++
                for (k = first; k < NF && $k != ""; k++) now[name, k] = $k
                known[name] = first
            } else if (name in known) {
                found++
                bad = 0
                for (k = first; k < NF; k++)
                    if ((name, k) in now && !near($k, now[name, k])) bad = $k " is " now[name, k]
                if (bad == 0) passed++
                else { failed++; print "bench/README.md: " name ": " bad }
            }
        }
        END {
            if (found < rows) { failed += rows - found; print "bench/README.md lacks a row of bench/size.sh" }
            printf "%d passed, %d failed\n", passed, failed
            exit failed > 0
        }' "$T/now" bench/README.md
    exit
}
if [ "$1" = check ]; then check; fi
build=${BUILD:-build}
small="-DSHADE_LANES=16 -DSHADE_MAX_VARYINGS=8"
mkdir -p "$build"
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$build/size.c"

# file, prefix: bytes of the sections whose names begin so
bytes_of() {
    size -A "$1" | awk -v name="$2" 'index($1, name) == 1 { n += $2 } END { print n + 0 }'
}

# Programs that call more and more of the library.  What they print keeps the compiler from
# computing it, and argc, which is 1, from knowing what goes in.
program() {
    printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n#include <stdio.h>\n'
    printf 'static uint32_t pixels[64 * 64]; static float depth[64 * 64];\n'
    printf 'static const float corner[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };\n'
    printf '%s\n' "$2"
    printf 'int main(int argc, char **argv)\n{\n    shade_vec3 n = shade_v3(0, 0, (float)argc);\n'
    printf '    (void)argv;\n    (void)pixels;\n    (void)depth;\n    (void)corner;\n%s\n}\n' "$1"
}
flat='static void place(const void *u, const shade_vertex_ids *SHADE_RESTRICT in,
                  shade_vertices *SHADE_RESTRICT out)
{
    const float *p = (const float *)u;
    SHADE_EACH_LANE(i) {
        for (int k = 0; k < 3; k++) out->clip[k][i] = p[3 * in->index[i] + (uint32_t)k];
        out->clip[3][i] = 1;
    }
}
static void paint(const void *u, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    (void)u;
    SHADE_EACH_LANE(i) { out->color[0][i] = in->x[i] / 64; }
}'
target='    shade_target t = { 0 };
    t.width = t.height = 64;
    t.color = pixels;
    t.depth = depth;
    shade_clear(&t, shade_v4(0, 0, 0, 1), 1);'
carried() {
    program '    return printf("%g %g\n", shade_lambert(n, n), shade_blinn_phong_specular(n, n, n, 9)) < 0;' \
        '' >"$build/carries_terms.c"
    program '    shade_lighting l = { 0 };
    shade_light lamp = shade_point_light(n, n);
    l.lights = &lamp;
    l.light_count = 1;
    return printf("%g\n", shade_lit(&l, NULL, n, n, n).x) < 0;' '' >"$build/carries_lit.c"
    program "$target"'
    shade_pipeline p = { 0 };
    p.vertex = place;
    p.fragment = paint;
    p.uniforms = corner;
    shade_draw(&t, &p, NULL, 3, 3, NULL);
    return printf("%u\n", (unsigned)pixels[64 * 32 + 32]) < 0;' "$flat" >"$build/carries_draw.c"
    program "$target"'
    shade_mesh mesh = { corner };
    shade_draw_state state = { 0 };
    shade_light lamp = shade_point_light(n, n);
    mesh.vertex_count = 3;
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    shade_draw_mesh(&t, &mesh, &state, NULL);
    return printf("%u\n", (unsigned)pixels[64 * 32 + 32]) < 0;' '' >"$build/carries_mesh.c"
    program '    return printf("%g\n", n.x) < 0;' '' >"$build/carries_nothing.c"

    echo "| kB of code and constants in a program that calls | as it comes | gc-sections | SHADE_STATIC | both, no dispatch |"
    echo "|---|---|---|---|---|"
    carried_row "\`shade_lambert\` and \`shade_blinn_phong_specular\`" terms
    carried_row "\`shade_lit\`" lit
    carried_row "\`shade_draw\`, with shaders of its own" draw
    carried_row "\`shade_draw_mesh\`" mesh
}
kilobytes() {    # program, flags: what it has beyond one that calls nothing and holds nothing
    name=$1
    shift
    for which in nothing "$name"; do
        static=
        [ $which = nothing ] && static=-DSHADE_STATIC
        $cc -std=c99 -I. $static "$@" "$build/carries_$which.c" -o "$build/carries" -lm 2>/dev/null
        echo $(($(bytes_of "$build/carries" .text) + $(bytes_of "$build/carries" .rodata)))
    done | awk 'NR == 1 { none = $1 } NR == 2 { kb = ($1 - none) / 1000; printf kb < 10 ? "%.1f" : "%.0f", kb }'
}
carried_row() {
    sections="-ffunction-sections -fdata-sections -Wl,--gc-sections"
    printf "| $1 | $(kilobytes $2 -O2) | $(kilobytes $2 -O2 $sections)"
    printf " | $(kilobytes $2 -O2 -DSHADE_STATIC)"
    echo " | $(kilobytes $2 -O2 -DSHADE_STATIC -DSHADE_NO_DISPATCH $sections) |"
}

# median of five compilations, processor time; no time where bytes alone are wanted
seconds() {
    for run in 1 2 3 4 5; do
        [ $run -gt 1 ] && [ "$only" = bytes ] && break
        { time -p $cc "$@" -std=c99 -I. -c "$build/size.c" -o "$build/size.o"; } 2>&1 |
            awk '$1 == "user" { print $2 }'
    done | sort -n | sed -n 3p
}
row() {
    title=$1
    shift
    time=$(seconds "$@")
    printf "| $title | \`$*\`"
    for name in .text .rodata .data .bss; do printf " | $(bytes_of "$build/size.o" $name)"; done
    echo " | $time |"
}
only=$1
echo "| shade.h | flags | .text | .rodata | .data* | .bss | seconds to compile |"
echo "|---|---|---|---|---|---|---|"
row "as it comes" -O2
row "no explanations" -O2 -DSHADE_NO_EXPLAIN
row "no dispatch" -O2 -DSHADE_NO_DISPATCH
row "small" -Os -DSHADE_NO_DISPATCH $small
row "least" -Os -DSHADE_NO_DISPATCH -DSHADE_NO_EXPLAIN $small
echo
echo "(* constants with pointers in them, .data.rel.ro.)"
echo
carried
[ "$only" = bytes ] && exit
echo
echo "Bytes of stack that \`shade_draw_mesh\` touches, measured:"

# program, flags
stack() {
    program=$build/$1
    shift
    $cc -std=c99 -I. "$@" bench/stack.c -o "$program" -lm -pthread
    echo
    echo "\`$*\`"
    echo
    "$program"
}
stack stack -O2
stack stack_small -O2 $small
stack stack_least -Os -DSHADE_NO_DISPATCH $small

# frames by the compiler's own account, largest first
if $cc -std=c99 -O2 -I. -fstack-usage -c "$build/size.c" -o "$build/size.o" 2>/dev/null; then
    echo
    echo "Largest frames, by \`-O2 -fstack-usage\`:"
    echo
    echo "| function | bytes |"
    echo "|---|---|"
    awk -F'\t' '{ n = split($1, p, ":"); print $2 "\t" p[n] }' "$build/size.su" |
        sort -rn | head -8 | awk -F'\t' '{ print "| " $2 " | " $1 " |" }'
fi
