# order.awk - what contact is called with: the pictures of standard input's lessons in the order of
# the tables of examples/README.md, below the headings of the tables.
#     echo 01_triangle 02_iterations | awk -f order.awk - examples/README.md
NR == FNR { for (i = 1; i <= NF; i++) left[$i] = 1; next }
/^## / { heading = substr($0, 4); gsub(/ /, "_", heading) }
match($0, /`[0-9][0-9]_[a-z_]*`/) {
    name = substr($0, RSTART + 1, RLENGTH - 2)
    if (!left[name]) next
    if (heading) print "=" heading
    print "out/" name ".ppm"
    left[name] = 0
    heading = ""
}
