#!/bin/sh
# The list of runs in a terminal, and attach that offers the live ones.
# Usage: runs_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

runs=$here/state/greenbody/runs
cd "$here" || exit 1
pids=
finish() {
    term kill-server 2>/dev/null
    for pid in $pids; do
        kill -KILL "$pid" 2>/dev/null
    done
    rm -rf "$here"
}

has_rows() { # directory
    grep -qs '^load,[2-9]' "$1/curve.csv"
}

begin() { # name: a run without a terminal
    # shellcheck disable=SC2086  # words
    setsid "$greenbody" run $long --quiet --out "$runs/$1" >/dev/null 2>&1 &
    is "$1 begins" until_true has_rows "$runs/$1"
    pids="$pids $(python3 -c 'import json, sys
print(json.load(open(sys.argv[1]))["pid"])' "$runs/$1/status.json")"
}

open_terminal
start attach
shows "attach without a live run says so" 'no run is live below'
shows "and what is accepted" 'status=2'
begin first
start attach
shows "the only live run is shown at once" 'The run\|N 6000'
shows "in the workbench" 'Parameters'
keys q
shows "q asks" 'Quit?'
keys y
shows "and leaves" 'status=0'
begin second
start attach
shows "of two a list is offered" '^ 1  [fs].* detached'
shows "both have a number" '^ 2  [fs].* detached'
shows "a number is asked for" 'number (Enter: none):'
keys 7 Enter
shows "another number is refused" 'accepted a number from 1 to 2'
shows "with status 2" 'status=2'
start attach
shows "the list again" 'number (Enter: none):'
keys Enter
shows "Enter takes none" 'status=0'
start attach
shows "the list a third time" 'number (Enter: none):'
keys 2 Enter
shows "a number opens that run" 'Parameters'
leaves "and it is left"
start attach second
shows "a name is enough" 'Parameters'
leaves "and is left"
# live: a run of this terminal, beside those without
start "$long"
is "the workbench computes one" until_true has_rows "$runs/default-1"
XDG_STATE_HOME=$here/state "$greenbody" runs >"$here/list"
is "which is live" grep -q '^default-1  *live [0-9]* %' "$here/list"
is "the others are detached" [ "$(grep -c 'detached [0-9]* %' "$here/list")" -eq 2 ]
leaves "and leaves"
start runs
shows "past ones stay listed" '^default-1  *stopped '
shows "the detached ones first" '^second  *detached\|^first  *detached'
is "no line is wrapped" [ "$(screen | grep -c ' [0-9][0-9]:[0-9][0-9]$')" -eq 3 ]

echo "1..$tests"
exit "$bad"
