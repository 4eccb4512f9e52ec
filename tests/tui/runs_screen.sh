#!/bin/sh
# The list of runs in a terminal, attach that offers them, a run that is left with d.
# Usage: runs_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

cd "$here" || exit 1

begin() { # name: a run without a terminal
    # shellcheck disable=SC2086  # words
    setsid "$greenbody" run $long --quiet --out "$runs/$1" >/dev/null 2>&1 &
    is "$1 begins" until_true has_rows "$runs/$1"
}

listed() { # pattern among the lines of `greenbody runs`
    XDG_STATE_HOME=$here/state "$greenbody" runs >"$here/list"
    grep -q "$1" "$here/list"
}

rows() { # directory
    wc -l <"$1/curve.csv"
}

has_more_rows() { # directory, number
    [ "$(rows "$1")" -gt "$2" ]
}

open_terminal
start attach
shows "attach without a run says so" 'there are no runs below'
shows "with status 2" 'status=2'
begin first
start attach
shows "a run is offered" '^ first  *detached [0-9]* %'
shows "and counted" '1 run, 1 live'
keys Enter
shows "Enter shows it in the workbench" 'Parameters'
leaves "where it is left"
begin second
"$greenbody" run default particles.count=60 loading.until=0.1MPa loading.unload_from= --quiet \
    --out "$runs/old" 2>/dev/null
start attach
shows "past runs are offered, too" '^ old  *done '
shows "behind the live ones" '3 runs, 2 live'
shows "with what the keys do" 'Enter shows  Del ^D deletes  typing filters  Esc leaves'
keys -l 'SEC'
hides "typing filters" '^ old '
shows "by the name" '^ second  *detached'
keys DC
shows "a live run is not deleted" 'a live run is not deleted'
keys Escape
shows "Esc ends the filter" '^ old '
keys -l 'done'
hides "the state counts, too" '^ second '
keys DC
shows "Del asks, with number and size" 'Delete it, [0-9]* files, [0-9.]* [kM]B? y deletes'
keys n
hides "n keeps it" 'y deletes'
is "with its files" [ -e "$runs/old/preset.ini" ]
keys C-d
shows "^D asks, too" 'y deletes'
term resize-window -x 60 -y 20
shows "at 60 x 20 nothing is cut" 'Esc leaves'
shows "density and pressure stand back" 'name  *state  *size  date'
shows "the question stays" 'y deletes, n keeps'
term resize-window -x 80 -y 24
keys y
shows "y deletes" 'deleted: old'
is "the folder" until_true [ ! -e "$runs/old" ]
shows "nothing else is listed now" 'no run matches'
keys Escape Escape
shows "Esc leaves" 'status=0'
start attach second
shows "a name is enough" 'Parameters'
leaves "and is left"

# --- a run of this terminal, left to go on
start "$long"
is "the workbench computes one" until_true computes "$runs/default-1"
is "which is live" listed '^default-1  *live [0-9]* %'
is "the others are detached" [ "$(grep -c 'detached [0-9]* %' "$here/list")" -eq 2 ]
keys q
shows "q offers to leave it running" 'd leave it running'
keys d
shows "d tells where it continues" 'continues without a terminal; .greenbody attach'
shows "and leaves" 'status=0'
is "the run is detached" until_true listed '^default-1  *detached [0-9]* %'
before=$(rows "$runs/default-1")
is "and goes on" until_true has_more_rows "$runs/default-1" "$before"
start attach
shows "attach finds it again" '^ default-1  *detached'
keys -l 'default-1'
hides "by its name" '^ first '
keys Enter
shows "and shows it" 'Parameters'
keys t
told "t takes it back" 'continues here'
leaves "and quits it"
is "the engine that is taken over ends by itself" until_true listed '^default-1  *stopped '
start runs
shows "past ones stay listed" '^default-1  *stopped '
shows "the detached ones first" '^second  *detached\|^first  *detached'
is "no line is wrapped" [ "$(screen | grep -c ' [0-9][0-9]:[0-9][0-9]$')" -eq 3 ]

echo "1..$tests"
exit "$bad"
