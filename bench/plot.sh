#!/bin/sh
# plot.sh - draws what run.sh left in BUILD as PNG charts, into OUT (from the top directory: out).
set -e
cd "$(dirname "$0")/.."
build=${BUILD:-build}
out=${OUT:-out}
command -v gnuplot >/dev/null || { echo "skipped: gnuplot not installed"; exit 0; }
mkdir -p "$out"

# name, size; commands come on standard input
chart() {
    {
        echo "set terminal pngcairo size $2 font 'sans,11' background '#ffffff'"
        echo "set output '$out/$1.png'"
        echo "set datafile separator '\\t'"
        echo "set border 3 lc rgb '#666666'; set tics nomirror; set grid y lc rgb '#dddddd' lt 1"
        cat
    } | gnuplot
    echo "$out/$1.png"
}

if [ -s "$build/bench_compare.tsv" ]; then
    # Bars from the top row down: how many times faster than the peer.
    awk -F'\t' '$4 > 0 { print }' "$build/bench_compare.tsv" >"$build/bench_ratio.tsv"
    rows=$(wc -l <"$build/bench_ratio.tsv")
    [ "$rows" -gt 0 ] && chart bench_compare "900,$((110 + 34 * rows))" <<PLOT
set label "shade.h beside llvmpipe on one core: times faster at the same pictures" \\
    at screen 0.02, screen 0.96
set tmargin 3
set style fill solid 1.0 noborder
stats '$build/bench_ratio.tsv' using 4 nooutput
set yrange [$rows - 0.4 : -0.6]
set xrange [0 : 1.3 * STATS_max]
set grid x noy
unset key
set border 1
set ytics scale 0
set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb '#aa3333' dt 2
plot '$build/bench_ratio.tsv' \
         using (\$4 / 2) : 0 : (\$4 / 2) : (0.3) : ytic(1) with boxxyerror lc rgb '#3b6ea5', \
     '' using 4 : 0 : (sprintf(' %.1f x   %.3g ms', \$4, \$2)) with labels left offset 0.3, 0
PLOT
fi

if [ -s "$build/bench_kernel.tsv" ]; then
    chart bench_kernel 760,440 <<PLOT
set title "Blinn-Phong, attenuated point lights: ns per pixel and light"
set logscale y
set logscale x 2
set xlabel "lights"
set xrange [0.9 : 18]
set yrange [1 : *]
set key outside right
plot for [name in "'plain loop, libm' SSE2 AVX2 AVX-512"] \
    "< grep '^" . name . "' '$build/bench_kernel.tsv'" \
        using 2 : 3 with linespoints lw 2 pt 7 title name
PLOT
fi

if [ -s "$build/bench_scaling.tsv" ]; then
    chart bench_triangles 760,440 <<PLOT
set title "Knot, Gouraud: ns per triangle"
set logscale xy
set xlabel "triangles"
set yrange [10 : *]
plot "< grep '^triangles' '$build/bench_scaling.tsv'" using 2 : 3 with linespoints lw 2 pt 7 \
         title "4 pixels each", \
     '' using 2 : 4 with linespoints lw 2 pt 7 title "at 1280 x 720"
PLOT
    chart bench_pixels 760,440 <<PLOT
set title "Two triangles over the picture: ns per pixel"
set logscale x
set xlabel "pixels"
set yrange [0 : *]
plot "< grep '^pixels' '$build/bench_scaling.tsv'" using 2 : 3 with linespoints lw 2 pt 7 \
         title "flat colour", \
     '' using 2 : 4 with linespoints lw 2 pt 7 title "four spotlights"
PLOT
fi
