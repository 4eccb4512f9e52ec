#!/bin/bash
# Eight processes of a sweep, and their workers, are killed, stopped and continued at random
# moments.  After all are continued and the command is repeated at most once, all runs are
# done, the tables are those of one process, and nothing is left running.
# Usage: chaos.sh GREENBODY PRESET_FOLDER ROUNDS [SEED]
. "$(dirname "$0")/folder.sh"

rounds=$3
RANDOM=${4:-1}
# for this test only: a container's root may start processes by mpirun
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

sweep=("$greenbody" sweep p1-nobridge-38nm particles.count=100 structure.base=auto
    'loading.until=5 MPa' loading.unload_from= numerics.fidelity=fast
    --vary 'contact.mu=0.1;0.3' --replicas 6 --at '2;5 MPa' --jobs 1)

ways=(alone)
if command -v mpirun >/dev/null; then
    ways+=('mpirun --oversubscribe -np 8'
        'mpirun --oversubscribe --enable-recovery -np 8')
else
    echo '# no mpirun here: processes are started one by one'
fi

start() { # way: eight processes in the background
    local k
    if [ "$1" = alone ]; then
        for k in 1 2 3 4 5 6 7 8; do
            "${sweep[@]}" --out shared >"out.$k" 2>&1 &
        done
    else
        # shellcheck disable=SC2086  # a list of words
        $1 "${sweep[@]}" --out shared >out.1 2>&1 &
    fi
}

# The processes of the sweep, workers included; not mpirun.
processes() {
    local pid name
    for pid in $(engines_left); do
        read -r name <"/proc/$pid/comm" 2>/dev/null && [ "$name" = greenbody ] && echo "$pid"
    done
}

disturb() { # what happens to one of them; SIGTERM is what batch systems send first
    local signals=(KILL STOP STOP CONT CONT TERM) all
    mapfile -t all < <(processes)
    [ ${#all[@]} -eq 0 ] || kill -s "${signals[RANDOM % 6]}" "${all[RANDOM % ${#all[@]}]}" \
        2>/dev/null
    sleep "0.0$((RANDOM % 10))"
}

continued() { # all go on until none is left
    local pid
    for pid in $(engines_left); do
        kill -CONT "$pid" 2>/dev/null
    done
    none_left
}

as_one() { # directory
    [ "$(grep -c ',done,$' "$1/runs.csv")" -eq 12 ] &&
        cmp -s one/sweep.csv "$1/sweep.csv" && cmp -s one/runs.csv "$1/runs.csv"
}

in_patience "${sweep[@]}" --out one >stdout 2>stderr
is 'one process' as_one one
for ((round = 1; round <= rounds; round++)); do
    way=${ways[(round - 1) % ${#ways[@]}]}
    rm -rf shared
    start "$way"
    until_true [ -d shared ]
    for ((k = RANDOM % 12; k >= 0; k--)); do
        disturb
    done
    repeated=
    if until_true continued && ! as_one shared 2>/dev/null; then
        repeated=', repeated'
        in_patience "${sweep[@]}" --out shared >stdout 2>stderr
    fi
    # shellcheck disable=SC2046  # numbers
    wait $(jobs -p) 2>/dev/null
    name="round $round, $way$repeated"
    if as_one shared && none_left && none_works shared; then
        result "$name" 0
    else
        diff one/runs.csv shared/runs.csv | sed 's/^/# /'
        result "$name" 1
        break
    fi
done

echo "1..$tests"
exit $bad
