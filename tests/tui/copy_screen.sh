#!/bin/sh
# Copies into the clipboard of the terminal, here tmux, whose paste buffer is read back.
# Usage: copy_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

holds() { # the newest paste buffer is this line
    [ "$(term show-buffer 2>/dev/null)" = "$1" ]
}

matches() { # it has this line
    term show-buffer 2>/dev/null | grep -q -- "$1"
}

forget() {
    while term delete-buffer 2>/dev/null; do :; done
}

open_terminal
start default particles.count=1000 loading.until=200MPa loading.unload_from=100MPa
shows "opens" '✓ done'
keys g
is "focus reaches mu" go_to mu
keys y
shows "y says what is copied" 'copied: contact.mu=0\.1'
is "the parameter, ready for the command line" until_true holds 'contact.mu=0.1'
keys + c
shows "c opens the command" 'greenbody run default'
keys y
shows "y there" 'copied: greenbody run default'
is "copies it in one line" until_true matches \
    '^greenbody run default contact.mu=0\.[0-9]* .loading.until=200 MPa. .loading.unload_from=100 MPa.$'
keys c
hides "c closes" 'y copies, c closes'
keys u @ '100 MPa' Enter
shows "the cursor at a pressure" 'density at 100 MPa'
keys y
is "is copied with its error" until_true matches '^density at 100 MPa: .*0\.[0-9]* +- 0\.[0-9]*'
keys '#'
shows "# opens the table" 'Densities of the curves'
keys y
shows "y there" 'copied: density at'
is "copies columns for a spreadsheet" until_true matches \
    "^density at$(printf '\t')10 MPa$(printf '\t')50 MPa"
is "with the densities" until_true matches "$(printf '\t')0\\.[0-9]*$(printf '\t')0\\."
keys Escape
hides "Esc closes it" 'copied: density at'
keys Escape y
is "without a cursor the folder of the run" until_true matches "^$here/state/greenbody/runs/"
is "which exists" [ -f "$(term show-buffer)/curve.csv" ]
leaves "quits"

# --- the sequence alone, which tmux accepts where it may
forget
term set-option -g set-clipboard on
start --clipboard=osc52 default particles.count=100 loading.until=20MPa loading.unload_from=10MPa
shows "opens with OSC 52 alone" '✓ done'
is "focus reaches alpha" go_to alpha
keys y
is "the terminal sets its clipboard" until_true holds 'contact.alpha=0.24'
leaves "quits"
forget
start --clipboard=off default particles.count=100 loading.until=20MPa loading.unload_from=10MPa
shows "opens without" '✓ done'
keys y
shows "and says why nothing is copied" 'not copied: the setting clipboard is off'
is "nothing is" [ -z "$(term list-buffers)" ]
leaves "quits"

# --- what is taken for the terminal
way() { # name, expected, variables...
    name=$1 expected=$2
    shift 2
    env -u TMUX -u STY "$@" "$greenbody" --diagnose >"$here/out" 2>&1
    is "$name" grep -q "^clipboard  $expected (" "$here/out"
}
way "xterm: OSC 52" 'OSC 52' TERM=xterm
way "screen has a passthrough" 'OSC 52 through screen' TERM=screen STY=1.pts
way "tmux another" 'OSC 52 and tmux' TERM=screen TMUX=/tmp/tmux,1,0
way "also beyond ssh" 'OSC 52 and tmux' TERM=tmux-256color

echo "1..$tests"
exit "$bad"
