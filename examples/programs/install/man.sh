#!/bin/sh
# man.sh PROGRAM NAME SENTENCE - prints the man page of a program, made from what its --help says:
# a usage line, lines of options ("  --name VALUE   text") with what continues them, other lines, and
# at the end lines that begin with "exit status:" and "formats:", and lists below "keys:" and "examples:".
# NAME is the name that the program is installed under.
program=$1 name=$2 sentence=$3
version=$("$program" --version) || exit 1
help=$("$program" --help) || exit 1
printf '%s\n' "$help" | awk -v name="$name" -v sentence="$sentence" -v version="${version##* }" '
function roff(text)                     # dashes of options stay dashes, a line is no request
{
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    sub(/^[.'\'']/, "\\\\\\&&", text)
    return text
}
NR == 1 {
    sub(/^usage: [^ ]+ */, "")
    files = note = $0
    sub(/   .*/, "", files)             # after three blanks stands a note
    if (sub(/.*   +/, "", note) == 0) note = ""
    print ".TH " toupper(name) " 1 \"\" \"shade.h " version "\""
    print ".SH NAME\n" name " \\- " roff(sentence)
    print ".SH SYNOPSIS\n.B " name "\n" roff(files)
    print ".SH DESCRIPTION\n" toupper(substr(sentence, 1, 1)) roff(substr(sentence, 2)) "."
    if (note != "") print "(" roff(note) ")"
    print ".SH OPTIONS"
    next
}
function status(text)
{
    if (!told) print ".SH \"EXIT STATUS\"\n" text
    told = 1
}
/^[^ ]/ { list = "" }
/^exit status: / { sub(/^exit status: /, ""); status(roff($0)); next }
/^formats: / {
    status("0: all was done.\n1: it was not, and a line on standard error tells why.")
    sub(/^formats: /, "")
    print ".SH FORMATS\n" roff($0) "."
    next
}
/^(keys|examples):$/ { list = toupper($0); sub(/:/, "", list); print ".SH " list; next }
list == "KEYS" {
    keys = substr($0, 3, 14)
    sub(/ +$/, "", keys)
    print ".TP\n.B " roff(keys) "\n" roff(substr($0, 18))
    next
}
list == "EXAMPLES" {
    sub(/^ +/, "")
    note = $0
    if (!sub(/.*   +/, "", note)) note = ""
    sub(/   .*/, "")
    print ".PP\n.nf\n.B " roff($0) "\n.fi"
    if (note != "") print "(" roff(note) ")"
    next
}
/^  --/ {
    option = $0
    sub(/^  /, "", option)
    text = option
    sub(/   .*|  .*/, "", option)
    text = substr(text, length(option) + 1)
    sub(/^ +/, "", text)
    print ".TP\n.B " roff(option) "\n" roff(text)
    next
}
/^    / { sub(/^ +/, ""); print roff($0); next }
NF && NR == unended + 1 { print roff($0) }
NF && NR != unended + 1 { print ".PP\n" toupper(substr($0, 1, 1)) roff(substr($0, 2)) }
NF && !/[.:]$/ { unended = NR }          # its sentence goes on in the next line
END {
    n = split("batch compare sheets thumbnail view", all, " ")
    print ".SH \"SEE ALSO\""
    for (k = 1; k <= n; k++)
        if ("shade-" all[k] != name) print ".BR shade\\-" all[k] " (1)" (++others < n - 1 ? "," : "")
}
'
