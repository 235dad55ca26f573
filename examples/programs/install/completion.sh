#!/bin/sh
# completion.sh PROGRAM NAME - prints the completion of a program for bash, made from what its --help
# says: the names of options, and values that it lists, as "a|b|c" or as words at the begin of the text.
# Files are those that bash offers by itself.
# NAME is the name that the program is installed under.
program=$1 name=$2
help=$("$program" --help) || exit 1
printf '%s\n' "$help" | awk -v name="$name" '
# The words that a text begins with, separated by commas and "or", where there are more than one
function words(text,    n, k, part, out)
{
    if (text !~ /^[^:]*,[^:]*:/) sub(/^[^:,(]*: /, "", text)    # "from where it is seen: front, ..."
    sub(/[:;(].*/, "", text)
    gsub(/ or /, ", ", text)
    n = split(text, part, /, */)
    for (k = 1; k <= n; k++) {
        sub(/ +$/, "", part[k])
        if (part[k] ~ /^[#A-Z]+$/) continue
        if (part[k] !~ /^[a-z][a-z0-9-]*$/) break
        out = out (out ? " " : "") part[k]
    }
    return out ~ / / ? out : ""
}
function end(    list)
{
    if (!option) return
    if (value ~ /^FILE/) files = files (files ? "|" : "") option
    else if (value ~ /^FOLDER/) folders = folders (folders ? "|" : "") option
    else if (value ~ /\|/) { list = value; gsub(/\|?[A-Z][A-Z%]*\|?/, "", list); gsub(/\|/, " ", list) }
    else if (value) list = words(text)
    options = options (options ? " " : "") option
    if (list) cases = cases "    " option ") COMPREPLY=($(compgen -W \"" list "\" -- \"$word\")); return ;;\n"
    else if (value && value !~ /^(FILE|FOLDER)/) free = free (free ? "|" : "") option
    option = value = text = ""
}
/^  --/ {
    end()
    option = $1
    sub(/,$/, "", option)
    if ($0 ~ /^  --help, --version/) { options = options " --help"; option = "--version" }
    else if ($0 ~ /^  --[^ ]* [^ ]/) value = $2
    text = $0
    sub(/^  --[^ ]*( [^ ]+)?  +/, "", text)
    next
}
/^      / && option { sub(/^ +/, ""); text = text " " $0; next }
{ end() }
END {
    end()
    call = name
    gsub(/-/, "_", call)
    print "# Completion of " name " for bash; made from what its --help says."
    print "_" call "()\n{"
    print "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}"
    print "    COMPREPLY=()"
    print "    case $before in"
    printf "%s", cases
    if (files) print "    " files ") return ;;"
    if (folders) print "    " folders ") compopt -o dirnames +o default 2>/dev/null; return ;;"
    if (free) print "    " free ") compopt +o default 2>/dev/null; return ;;"
    print "    esac"
    print "    [[ $word != -* ]] || COMPREPLY=($(compgen -W \"" options "\" -- \"$word\"))\n}"
    print "complete -o default -F _" call " " name
}'
