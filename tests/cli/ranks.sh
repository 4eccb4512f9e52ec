#!/bin/sh
# `greenbody sweep` under mpirun: the tables of one process, also when a rank is killed.
# Usage: ranks.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"
export GB_DATA_DIR="$presets/../assets/data"

# for this test only: a container's root may start ranks
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

if ! "$greenbody" --version | grep -q ', MPI' || ! mpirun --version >/dev/null 2>&1; then
    echo '1..0 # SKIP built without MPI, or no mpirun'
    exit 0
fi

scene='p1-nobridge-38nm particles.count=200 structure.base=auto loading.unload_from='
scene="$scene numerics.fidelity=fast"
ranks='mpirun --oversubscribe --enable-recovery'

sweep() { # more arguments
    # shellcheck disable=SC2086  # lists of words
    $start "$greenbody" sweep $scene --set 'loading.until=10 MPa' \
        --vary 'contact.mu=0.1;0.3' --replicas 4 "$@" >stdout 2>stderr
}

start=
sweep --jobs 1 --out one
start="$ranks -np 2"
sweep --out two
is 'two ranks end with status 0' [ $? -eq 0 ]
is 'and give the tables of one process' cmp one/sweep.csv two/sweep.csv
is 'and its list of runs' cmp one/runs.csv two/runs.csv

papers() { # directory
    $start "$greenbody" papers --fast --only P1-fig6 --count 100 --cells 2 --out "$1" \
        >stdout 2>stderr
}

start=
papers three
start="$ranks -np 2"
papers four
is 'the numbers of the papers are those of one process' cmp three/papers.csv four/papers.csv
is 'and their list of runs' cmp three/runs.csv four/runs.csv

start='mpirun --oversubscribe -np 2'
sweep --at 5 --out out
is 'wrong input ends all ranks with its status' [ $? -eq 2 ]
is 'told once' [ "$(grep -c '^greenbody: ' stderr)" -eq 1 ]

# --- a rank that is killed, and one that is asked to end ------------------------------------
killed_at_once() {
    kill -KILL "$1"
}

asked() {
    kill -TERM "$1"
}

# As by a batch system: asked, then killed before its runs have answered.
asked_then_killed() {
    workers=$(pgrep -P "$1")
    # shellcheck disable=SC2086  # a list
    kill -STOP $workers
    asked "$1"
    sleep 1
    # shellcheck disable=SC2086
    kill -KILL "$1" $workers
}

both_work() { # directory
    [ "$(find . -path "./$1/*/status.json" | wc -l)" -ge 2 ] || ! kill -0 $mpirun
}

# One of the ranks of $mpirun, while it has work: then $ended is its id.
end_rank() { # directory, what ends it, its number
    until_true both_work "$1"
    for pid in $(pgrep -P $mpirun); do
        if tr '\0' '\n' <"/proc/$pid/environ" | grep -qx "OMPI_COMM_WORLD_RANK=$3" &&
            [ -n "$(pgrep -P "$pid")" ]; then
            "$2" "$pid"
            ended=$pid
        fi
    done
}

# Larger and larger runs, until the rank is met before the work is done: how large depends on
# how much faster the ranks are than this script.
without() { # directory, what ends a rank while both work, its number
    ended=
    count=400
    while [ -z "$ended" ] && [ $count -le 25600 ]; do
        rm -rf "$1"
        # shellcheck disable=SC2086
        $ranks -np 2 "$greenbody" sweep $scene --set 'loading.until=10 MPa' \
            --set particles.count=$count --vary 'contact.mu=0.1;0.3' --replicas 4 --yes \
            --out "$1" >stdout 2>stderr &
        mpirun=$!
        end_rank "$1" "$2" "$3"
        wait $mpirun
        count=$((2 * count))
    done
    is "$1: rank $3 was met" [ -n "$ended" ]
    is "$1: all runs are done by the others" [ "$(grep -c ',done,$' "$1/runs.csv")" -eq 8 ]
}
without killed killed_at_once 1
without left asked 1
without lost asked_then_killed 1
without headless killed_at_once 0
is 'one run at once on each, as before' \
    [ "$(grep '^[0-9]* runs, .* done before; ' stderr | grep -vc '; 1 at once$')" -eq 0 ]
is 'and the means are written' [ "$(grep -c '^[12],0.[13],load,10,4,' headless/sweep.csv)" -eq 2 ]

echo "1..$tests"
exit $bad
