#!/bin/bash
# The workbench loses its terminal, under tmux and under a bare pseudo-terminal: the engine
# goes on, the rest is idle, attach shows the run and takes it over.
# Usage: life.sh GREENBODY PRESET_FOLDER TIMES
. "$(dirname "$0")/terminal.sh"
times=$3
engine=

mkfifo "$here/input" || exit 1

result() { # name, 0 when good
    tests=$((tests + 1))
    if [ "$2" -eq 0 ]; then
        echo "ok $tests $1"
    else
        echo "not ok $tests $1"
        screen 2>/dev/null | sed 's/^/# /'
        sed 's/^/# /' "$run/status.json" "$run/events.log" 2>/dev/null
        bad=1
    fi
}

is() { # name, command...
    local name=$1
    shift
    until_true "$@"
    result "$name" $?
}

rows() {
    grep -vc '^#' "$run/curve.csv" 2>/dev/null || echo 0
}

more_rows() { # than
    [ "$(rows)" -gt "$1" ]
}

status_is() {
    grep -q "\"state\" : \"$1\"" "$run/status.json" 2>/dev/null
}

pid() {
    sed -n 's/.*"pid" : \([0-9]*\).*/\1/p' "$run/status.json"
}

# The status is written beside the engine: the first rows may be there before it.
other_pid() { # than
    [ -n "$(pid 2>/dev/null)" ] && [ "$(pid)" != "$1" ]
}

# The engine of the run, which is not that one.
find_engine() { # pid
    until_true other_pid "$1"
    engine=$(pid)
}

gone() { # pid
    ! kill -0 "$1" 2>/dev/null
}

# Clock ticks the first thread, that of the screen, has taken.
ticks() {
    awk '{ print $14 + $15 }' "/proc/$1/task/$1/stat"
}

# Well under a percent of two seconds.
idle() { # pid
    local before
    before=$(ticks "$1")
    sleep 2
    [ $(($(ticks "$1") - before)) -le 2 ]
}

# takes far longer than any of what is done with it
scene="default particles.count=1000 numerics.tolerance=1e-3 loading.step=0.002% \
output.checkpoint_every=0.5s numerics.fidelity=reference"

lives_on() { # name
    local before
    before=$(rows)
    is "$1: the engine goes on" more_rows $((before + 3))
    kill -0 "$engine" 2>/dev/null
    result "$1: it is the same process" $?
    is "$1: the rest is idle" idle "$engine"
}

# An event on the screen may scroll away before it is looked for; the log keeps it.
event() { # text
    grep -q -- "$1" "$run/events.log" 2>/dev/null
}

ends() { # name
    kill -TERM "$engine"
    is "$1: TERM ends it" gone "$engine"
    engine=
    status_is stopped && [ -s "$run/state.h5" ]
    result "$1: with a checkpoint" $?
}

under_tmux() {
    rm -rf "$here/state"
    run=$here/state/greenbody/runs/default-1
    term new-session -d -x 100 -y 30 "$greenbody $scene"
    is 'tmux: the run is kept' more_rows 3
    find_engine ''
    close_terminal
    lives_on tmux
}

under_pty() {
    rm -rf "$here/state"
    run=$here/state/greenbody/runs/default-1
    # its input never ends, and it is the terminal
    (exec script -qfc "stty rows 30 cols 100; exec $greenbody $scene" /dev/null \
        <>"$here/input" >/dev/null 2>&1) &
    terminal=$!
    is 'pty: the run is kept' more_rows 3
    find_engine ''
    kill -KILL $terminal
    ended $terminal 2>/dev/null
    lives_on pty
}

for _ in $(seq "$times"); do
    under_pty
    ends pty
    under_tmux
    term new-session -d -x 100 -y 30 "$greenbody attach $run; sleep 100"
    is 'attach shows it' has 'running'
    is 'with its density' has 'density *0\.[2-9]'
    kill -0 "$engine"
    result 'and leaves it alone' $?
    before=$engine
    term send-keys t
    is 'taken over: its engine ends' gone "$before"
    is 'and goes on here' event 'resumed from the checkpoint'
    find_engine "$before"
    at=$(rows)
    is 'with more rows' more_rows $((at + 2))
    close_terminal
    lives_on 'taken over'
    ends 'taken over'
done

# --- on_hangup = stop ---------------------------------------------------------------------
rm -rf "$here/state"
run=$here/state/greenbody/runs/default-1
term new-session -d -x 100 -y 30 "$greenbody $scene output.on_hangup=stop"
is 'stop: the run is kept' more_rows 3
find_engine ''
stopped=$engine
engine=
close_terminal
is 'stop: the engine ends with its terminal' gone "$stopped"
status_is stopped && [ -s "$run/state.h5" ]
result 'stop: with a checkpoint' $?
"$greenbody" verify "$run" >"$here/out" 2>&1
grep -qx equal "$here/out"
result 'stop: which verify repeats' $?

# --- without a screen ---------------------------------------------------------------------
run=$here/quiet
# The tests themselves may run under nohup, and an ignored HUP stays ignored.
# shellcheck disable=SC2086  # words
env --default-signal=HUP "$greenbody" run $scene --out "$run" 2>/dev/null &
engine=$!
is 'run: it is kept' more_rows 3
kill -HUP $engine
before=$(rows)
is 'run: HUP lets it go on' more_rows $((before + 3))
is 'run: and is told among the events' grep -q 'terminal closed' "$run/events.log"
ends run

# --- an engine that was killed, and a log that is a pipe -----------------------------------
run=$here/killed
# shellcheck disable=SC2086  # words
"$greenbody" run $scene --out "$run" 2>/dev/null &
engine=$!
is 'killed: the run is kept' more_rows 3
kill -KILL $engine
ended $engine 2>/dev/null
engine=
grep -q '"state" : "running"' "$run/status.json"
result 'killed: its status still says that it runs' $?
rm -rf "$here/state"
mkdir -p "$here/state/greenbody"
mkfifo "$here/state/greenbody/workbench.log"
term new-session -d -x 100 -y 30 "exec $greenbody attach $run"
is 'killed: attach says that its engine is gone' has 'ended without a final'
is 'killed: and that it is stopped' has 'stopped'
is 'log: the screen says that there is none' has 'nothing is logged: .*is not a regular'
watcher=$(term display -p '#{pane_pid}')
kill -TERM "$watcher"
is 'log: TERM ends it' gone "$watcher"
close_terminal
rm -rf "$here/state"
run=$here/quiet

# --- the directory goes away --------------------------------------------------------------
# shellcheck disable=SC2086  # words
"$greenbody" run $scene --out "$run-2" 2>"$here/err" &
engine=$!
run=$run-2
is 'lost: the run is kept' more_rows 3
term new-session -d -x 100 -y 30 "$greenbody attach $run"
is 'lost: attach shows it' has 'running'
"$greenbody" attach "$run" >"$here/out" 2>"$here/attach" &
watcher=$!
is 'lost: without a screen, too' grep -q density "$here/attach"
mv "$run" "$here/gone" # at once: rm alone may find what is written meanwhile
until_true rm -rf "$here/gone"
ended $watcher
[ $? -eq 3 ] && grep -q 'quiet-2: was moved or removed' "$here/attach"
result 'lost: attach ends with a line and status 3' $?
ended $engine
[ $? -eq 3 ] && grep -q 'quiet-2: was moved or removed' "$here/err"
result 'lost: so does the engine' $?
is 'lost: the screen says it' has 'was moved or removed'
is 'lost: and that it failed' has 'failed'
engine=
[ ! -e "$run" ]
result 'lost: nothing comes there again' $?

echo "1..$tests"
exit $bad
