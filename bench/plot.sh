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
    # Bars from the top row down: how many times faster than the peer, with the widest vectors and,
    # where run.sh measured levels, with SSE2; slower ones are red.
    [ -s "$build/bench_level_0.tsv" ] || : >"$build/bench_level_0.tsv"
    awk -F'\t' -v OFS='\t' 'FILENAME == ARGV[1] { narrow[$1] = $4; next }
        $4 > 0 { print $1, $2, $4, narrow[$1] + 0 }' \
        "$build/bench_level_0.tsv" "$build/bench_compare.tsv" >"$build/bench_ratio.tsv"
    rows=$(wc -l <"$build/bench_ratio.tsv")
    [ "$rows" -gt 0 ] && chart bench_compare "960,$((150 + 44 * rows))" <<PLOT
set label 1 "shade.h beside llvmpipe, one core each, the same pictures: how many times as fast" \\
    at screen 0.02, screen 0.965 font ',13'
set label 2 "1: as fast as llvmpipe" at 1, graph 1.012 center tc rgb '#aa3333'
set label 3 "thick: the widest vectors, and ms a frame" \\
    at screen 0.02, screen 0.925 tc rgb '#3b6ea5'
stats '$build/bench_ratio.tsv' using 4 name 'NARROW' nooutput
if (NARROW_max > 0) {
    set label 4 "thin: SSE2 alone, as any x86-64 has it" \\
        at screen 0.39, screen 0.925 tc rgb '#7799bb'
}
set label 5 "red: slower than llvmpipe" at screen 0.74, screen 0.925 tc rgb '#cc4433'
set tmargin 6.5
set style fill solid 1.0 noborder
stats '$build/bench_ratio.tsv' using 3 nooutput
set yrange [$rows - 0.4 : -0.6]
set xrange [0 : 1.25 * STATS_max]
set xlabel 'how many times as fast as llvmpipe'
set grid x noy
unset key
set border 1
set ytics scale 0
set arrow from 1, graph 0 to 1, graph 1 nohead front lw 1.5 lc rgb '#aa3333' dt 2
color(x, wide) = x < 1 ? 0xcc4433 : wide ? 0x3b6ea5 : 0x99b5d0
plot '$build/bench_ratio.tsv' \
         using (\$3 / 2) : (\$0 - 0.1) : (\$3 / 2) : (0.22) : (color(\$3, 1)) : ytic(1) \
         with boxxyerror lc rgb variable, \
     '' using (\$4 / 2) : (\$0 + 0.24) : (\$4 / 2) : (0.09) : (color(\$4, 0)) \
         with boxxyerror lc rgb variable, \
     '' using 3 : (\$0 - 0.1) : (sprintf(' %.1f   %.3g ms', \$3, \$2)) \
         with labels left offset 0.3, 0, \
     '' using (\$4 > 0 ? \$4 : NaN) : (\$0 + 0.25) : (sprintf(' %.2g', \$4)) \
         with labels left offset 0.3, 0 font ',9' tc rgb '#666666'
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
    bands() { echo "< grep -P '^bands\\t$1' '$build/bench_scaling.tsv'"; }    # row of the table, chunks
    chart bench_bands 960,520 <<PLOT
set title "One picture in bands: how many times as fast as one band, if each had a core" font ',13'
set logscale xy 2
set xlabel "bands"
set xrange [1 : 66]
set yrange [1 : 64]
set xtics (1, 2, 4, 8, 16, 32, 64)
set ytics (1, 2, 4, 8, 16, 32, 64)
set key top left reverse Left
plot x title "as many times as there are bands" lc rgb '#999999' dt 2, \
     "$(bands '2 1')" using 3 : 4 with linespoints lw 2 pt 7 lc rgb '#3b6ea5' \
         title "101k triangles in any order, sorted into chunks", \
     "$(bands '0 1')" using 3 : 4 with linespoints lw 2 pt 7 lc rgb '#2f8f4e' \
         title "in their own order, along the knot, in chunks", \
     "$(bands '0 0')" using 3 : 4 with linespoints lw 2 pt 7 lc rgb '#cc4433' \
         title "without chunks"
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
