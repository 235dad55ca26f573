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
    # Bars from the top row down: how many times faster than the best peer, with the widest vectors
    # and, where run.sh measured levels, with SSE4.1 beside peers of 128 bits; slower ones are red.
    # Lines without tabs tell of the machine.
    [ -s "$build/bench_level_1.tsv" ] || : >"$build/bench_level_1.tsv"
    awk -F'\t' -v OFS='\t' 'NF > 1 && FILENAME == ARGV[1] { narrow[$1] = $4; who[$1] = $5; next }
        NF > 1 && $4 > 0 { print $1, $2, $4, $5, narrow[$1] + 0, who[$1] == "" ? "-" : who[$1] }' \
        "$build/bench_level_1.tsv" "$build/bench_compare.tsv" >"$build/bench_ratio.tsv"
    rows=$(wc -l <"$build/bench_ratio.tsv")
    notes=$(awk -F'\t' 'NF == 1' "$build/bench_compare.tsv" | tr -d '`"\\')
    lines=$(printf '%s\n' "$notes" | wc -l)
    high=$((170 + 44 * rows + 17 * lines))
    [ "$rows" -gt 0 ] && chart bench_compare "960,$high" <<PLOT
high = $high.0
set label 1 "shade.h beside the best peer of each row, one core each, the same pictures" \\
    at screen 0.02, screen 1 - 30 / high font ',13'
set label 2 "1: as fast as the peer" at 1, graph 1.012 center tc rgb '#aa3333'
set label 3 "thick: the widest vectors, and ms a frame" \\
    at screen 0.02, screen 1 - 62 / high tc rgb '#3b6ea5'
stats '$build/bench_ratio.tsv' using 5 name 'NARROW' nooutput
if (NARROW_max > 0) {
    set label 4 "thin: SSE4.1 beside peers of 128 bits" \\
        at screen 0.39, screen 1 - 62 / high tc rgb '#7799bb'
}
set label 5 "red: slower than the peer" at screen 0.74, screen 1 - 62 / high tc rgb '#cc4433'
set label 6 "$(printf '%s\n' "$notes" | awk '{ printf "%s%s", (NR > 1 ? "\\n" : ""), $0 }')" \\
    at screen 0.02, screen (17.0 * $lines - 3) / high noenhanced font ',9' tc rgb '#666666'
set tmargin at screen 1 - 100 / high
set bmargin at screen (17.0 * $lines + 55) / high
set style fill solid 1.0 noborder
stats '$build/bench_ratio.tsv' using 3 nooutput
set yrange [$rows - 0.4 : -0.6]
set xrange [0 : 1.5 * STATS_max]
set xlabel 'how many times as fast as the best peer'
set grid x noy
unset key
set border 1
set ytics scale 0
set arrow from 1, graph 0 to 1, graph 1 nohead front lw 1.5 lc rgb '#aa3333' dt 2
color(x, wide) = x < 1 ? 0xcc4433 : wide ? 0x3b6ea5 : 0x99b5d0
beyond(x) = x < 1 ? 1 : x    # labels keep off the line at 1
plot '$build/bench_ratio.tsv' \
         using (\$3 / 2) : (\$0 - 0.1) : (\$3 / 2) : (0.22) : (color(\$3, 1)) : ytic(1) \
         with boxxyerror lc rgb variable, \
     '' using (\$5 / 2) : (\$0 + 0.24) : (\$5 / 2) : (0.09) : (color(\$5, 0)) \
         with boxxyerror lc rgb variable, \
     '' using (beyond(\$3)) : (\$0 - 0.1) : \
         (sprintf(' %.2g   %.3g ms   %s', \$3, \$2, strcol(4))) with labels left offset 0.3, 0, \
     '' using (\$5 > 0 ? beyond(\$5) : NaN) : (\$0 + 0.25) : \
         (sprintf(' %.2g   %s', \$5, strcol(6))) \
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
