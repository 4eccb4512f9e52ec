#!/bin/sh
# What the screen says of engines: of this process, of another one, of one that has ended.
# Usage: attach.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

opens() { # arguments of greenbody
    term respawn-pane -k "$greenbody $*; echo status=\$?; exec sleep 10000"
    shows "opens $1" 'Parameters'
}

has_rows() {
    grep -qs '^load,[2-9]' "$here/run/curve.csv"
}

term new-session -d -x 140 -y 40 'exec sleep 10000'
# Its parent never asks for its status: killed, it stays in the list of processes.
# shellcheck disable=SC2086  # words
sh -c 'pid=$1; shift; "$@" 2>/dev/null & echo $! >"$pid"; exec sleep 100000' sh "$here/pid" \
    "$greenbody" run $long output.checkpoint_every=0.1s --out "$here/run" &
until_true has_rows
other=$(cat "$here/pid")
is 'an engine without a screen' has_rows

# --- the run of another process -----------------------------------------------------------
opens attach "$here/run"
shows 'attach shows it' 'running'
keys q
shows 'q asks' 'Quit?'
shows 'the run of another process goes on' 'The attached run continues in its process'
is 'and does not end' has_not 'The run ends'
keys n
hides 'n goes back' 'Quit?'
keys r
told_started() {
    has 'run [0-9]* started' || has 'quick cell'
}
until_true told_started
result 'r starts a run of this process' $?
starts_replicas() {
    keys R
    shows 'R asks how many cells' 'Replicas of this scene'
    keys C-u
    keys -l 3
    keys Enter
}
starts_replicas
# processes whose first word is greenbody, of a folder that no other test has
children() {
    pgrep -f "^greenbody sweep .*$here/state"
}
no_children() {
    ! children >"$here/children"
}
until_true children >"$here/children"
result 'replicas of an attached screen are kept in the folder of runs' $?
# shellcheck disable=SC2046  # words
kill -TERM $(children)
until_true no_children
keys q
shows 'q asks again' 'Quit?'
shows 'this one ends' 'The run ends and is not stored'
shows 'and the other one goes on' 'The attached run continues'
keys y
shows 'y quits' 'status=0'
kill -0 "$other"
result 'and the engine goes on' $?

# --- an engine that has ended ---------------------------------------------------------------
opens attach "$here/run"
shows 'attach shows it again' 'running'
kill -KILL "$other"
shows 'killed: it is stopped' 'stopped'
shows 'killed: with what to do' 'greenbody resume'
is 'killed: nothing runs' has_not 'running'
keys q
shows 'killed: q leaves at once' 'status=0'
grep -q '"state" : "running"' "$here/run/status.json"
result 'killed: though the last status says running' $?
grep -q '^State:.*Z' "/proc/$other/status"
result 'killed: and the process is still listed' $?
timeout 100 "$greenbody" attach "$here/run" >"$here/out" 2>&1
grep -q "has ended without a final status: t here or .greenbody resume $here/run" "$here/out"
result 'killed: without a screen, too' $?

# --- a run of this process ------------------------------------------------------------------
opens "$long"
shows 'a run of the workbench' 'running'
own_has_rows() {
    grep -qs '^load,[2-9]' "$here"/state/greenbody/runs/*/curve.csv
}
until_true own_has_rows
rm -rf "$here"/state/greenbody/runs/*replicas*
starts_replicas
works() {
    find "$here/state" -name status.json | grep -q replicas
}
until_true works
are_named() { # the command and its workers
    [ "$(children | wc -l)" -gt 1 ] && for child in $(children); do
        [ "$(cat "/proc/$child/comm")" = greenbody ] || return 1
    done
}
until_true are_named
result 'replicas are of processes called greenbody' $?
keys q
shows 'q asks' 'Quit?'
shows 'it ends' 'The run ends, with a checkpoint'
is 'the replicas do not' has 'replicas: continued by a process'
keys y
shows 'y quits' 'status=0'
children >"$here/children"
result 'and the replicas go on' $?
# shellcheck disable=SC2046  # words
kill -TERM $(children)
until_true no_children
is 'with a checkpoint' [ -s "$(echo "$here"/state/greenbody/runs/*/state.h5)" ]

echo "1..$tests"
exit $bad
