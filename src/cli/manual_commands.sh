#!/bin/sh
# A manual page for each command, from its help and the tables of the program.
# Usage: manual_commands.sh GREENBODY VERSION FOLDER
set -eu

greenbody=$1
version=$2
folder=$3
export LC_ALL=C
# a program built with AddressSanitizer writes help, too
export ASAN_OPTIONS=detect_leaks=0

# Text as it stands: no requests, no escapes, hyphens that can be copied.
verbatim() {
    sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/"
}

# Its first line is "  greenbody NAME [OPTION...] WORDS".
page() { # name, what it does
    help=$("$greenbody" "$1" --help | verbatim)
    printf '.TH "GREENBODY\\-%s" 1 "" "greenbody %s" "User Commands"\n' "$1" "$version"
    printf '.SH NAME\ngreenbody\\-%s \\- %s\n' "$1" "$(printf '%s\n' "$2" | verbatim)"
    printf '.SH SYNOPSIS\n.nf\n%s\n.fi\n' \
        "$(printf '%s\n' "$help" | sed -n '/^Usage:/,/^$/p' | sed -e 1d -e '/^$/d' -e 's/^  *//')"
    printf '.SH DESCRIPTION\n.nf\n%s\n.fi\n' \
        "$(printf '%s\n' "$help" | sed '1,/^$/d')"
    printf '.SH EXIT STATUS\n'
    "$greenbody" --exit-statuses | verbatim |
        sed -e 's/^\([0-9]*\) /.TP\n.B \1\n/'
    printf '.SH SEE ALSO\n.BR greenbody (1)\n'
}

"$greenbody" --commands | while read -r name summary; do
    page "$name" "$summary" >"$folder/greenbody-$name.1"
done
