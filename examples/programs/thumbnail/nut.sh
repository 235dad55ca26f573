#!/bin/sh
# nut.sh - prints a hexagon nut as an OBJ file: a model to try thumbnail on.
awk 'BEGIN {
    pi = atan2(0, -1); n = 96
    for (i = 0; i < n; i++) {
        t = 2 * pi * i / n; corner = t % (pi / 3) - pi / 6; outer = 1.7 * cos(pi / 6) / cos(corner)
        for (ring = 0; ring < 4; ring++) {          # outside below and above, hole above and below
            r = ring < 2 ? outer : 0.9
            printf "v %.5f %.5f %.5f\n", r * cos(t), ring == 1 || ring == 2 ? 1.2 : 0, r * sin(t)
        }
    }
    for (i = 0; i < n; i++) for (ring = 0; ring < 4; ring++) {
        j = (i + 1) % n; next_ring = (ring + 1) % 4
        print "f", 4 * i + ring + 1, 4 * i + next_ring + 1, 4 * j + next_ring + 1, 4 * j + ring + 1
    }
}'
