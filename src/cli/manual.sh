#!/bin/sh
# Fills the manual page from the program itself, so that it cannot leave out a command, an
# option or a key.  Usage: manual.sh TEMPLATE GREENBODY VERSION >greenbody.1
set -eu

template=$1
greenbody=$2
version=$3
export LC_ALL=C
# a program built with AddressSanitizer writes help, too
export ASAN_OPTIONS=detect_leaks=0

# Text as it stands: no requests, no escapes, hyphens that can be copied.
verbatim() {
    sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/"
}

commands() {
    "$greenbody" --commands | while read -r name summary; do
        printf '.SS "greenbody %s: %s"\n.nf\n' "$name" "$summary"
        "$greenbody" "$name" --help | verbatim
        printf '.fi\n'
    done
}

# name in ten columns, then what it does
workbench() {
    "$greenbody" --keys | sed -e 's/^\(.\{10\}\)\(.*\)$/\1\n\2/' -e 's/ *\n/\n/' |
        verbatim | sed -e 's/^/.B /' -e 'i .TP' -e n
}

# The help page of the workbench itself.
screen() {
    "$greenbody" --color=auto --help | verbatim
}

# | `key` | default | range | unit | meaning | source |
keys() {
    "$greenbody" params --markdown | sed 1,2d | verbatim |
        awk -F ' *[|] *' '{
            gsub("`", "", $2)
            printf ".TP\n.BI %s \" = %s\"\n%s; %s\n", $2, $3, $6, $4
        }'
}

statuses() {
    "$greenbody" --exit-statuses | verbatim | sed -e 's/^\([0-9]*\) /.TP\n.B \1\n/'
}

# The manual pages of the commands.
pages() {
    "$greenbody" --commands | sed -e 's/^\([a-z]*\) .*/.BR greenbody\\-\1 (1),/' -e '$s/,$//'
}

while IFS= read -r line; do
    case $line in
    @COMMANDS@) commands ;;
    @KEYS@) keys ;;
    @STATUSES@) statuses ;;
    @PAGES@) pages ;;
    @WORKBENCH@) workbench ;;
    @SCREEN@) screen ;;
    *@VERSION@*) printf '%s%s%s\n' "${line%%@VERSION@*}" "$version" "${line#*@VERSION@}" ;;
    *) printf '%s\n' "$line" ;;
    esac
done <"$template"
