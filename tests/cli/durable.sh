#!/bin/bash
# What outlasts a power failure: files are on the disk before they get their name, and what a
# failure may leave of a run resumes to the bits of an undisturbed one.
# Usage: durable.sh GREENBODY PRESET_FOLDER SYNC_LOG_SO
. "$(dirname "$0")/folder.sh"

if ! LD_PRELOAD=$3 "$greenbody" --version >stdout 2>stderr; then
    echo "1..0 # SKIP this program takes no other fsync"
    exit 0
fi

scene=(default loading.step=0.02% "loading.until=40 MPa" loading.unload_from=
    output.checkpoint_every=0.1s)

# The rows without their times; seconds are the 14th column.
rows() {
    grep -av '^#' "$1/curve.csv" | cut -d, -f1-13,15-
}

# --- the order of writing -------------------------------------------------------------------
# A run of so many particles, with a log of what it has the disk do: paths without the folder
# of the test, and without the ends of temporary names.
run_logged() {
    rm -rf new log
    SYNC_LOG=$here/log LD_PRELOAD=$3 "$greenbody" run "${scene[@]}" "$1" --quiet --out "$2" \
        >stdout 2>stderr
    ended=$?
    sed -E "s#$(pwd -P)#.#; s#(\.h5|\.ini|\.json)\.[A-Za-z0-9]+\$#\1+#" log >calls
}
# Larger and larger ones, until one lasts for several checkpoints on this machine.
count=300
run_logged particles.count=$count new/run "$3"
while [ $count -lt 10000 ] && [ "$(grep -c 'rename state.h5' calls)" -lt 4 ]; do
    count=$((2 * count))
    run_logged particles.count=$count new/run "$3"
done
scene+=(particles.count=$count)
is 'a run' [ $ended -eq 0 ]

# file, what is synced before it is renamed; the folder is synced behind
in_order() {
    file=$1
    before=$2
    awk -v file="$file" -v before="$before" '
        BEGIN { count = split(before, want, " ") }
        { line[NR] = $0 }
        $0 == "rename " file {
            found++
            for (k = 1; k <= count; k++) {
                if (line[NR - count - 1 + k] != "fsync ./new/run/" want[k]) { bad = 1 }
            }
            behind = NR + 1
        }
        NR == behind && $0 != "fsync ./new/run" { bad = 1 }
        END { exit bad || !found || NR < behind }' calls
}
is 'folders are on the disk with their names' \
    [ "$(head -n 2 calls | sort | tr '\n' ' ')" = 'fsync . fsync ./new ' ]
is 'the preset, before its name' in_order preset.ini 'preset.ini+'
is 'a state, behind the rows that it counts' in_order state.h5 'curve.csv events.log state.h5+'
is 'rows and status at the end' [ "$(tail -n 3 calls | tr '\n' ' ')" = \
    'fsync ./new/run/status.json+ rename status.json fsync ./new/run ' ]
is 'several states' [ "$(grep -c 'rename state.h5' calls)" -gt 1 ]

# --- what a failure leaves --------------------------------------------------------------------
rows new/run >whole.rows
has_state() {
    [ -e out/state-before.h5 ] || ! kill -0 $pid
}
"$greenbody" run "${scene[@]}" --quiet --out out >stdout 2>stderr &
pid=$!
until_true has_state
kill -KILL $pid
ended $pid 2>/dev/null
# Behind the last checkpoint rows may be zeros, the status empty, a name temporary.
head -c 3000 /dev/zero >>out/curve.csv
head -c 100 /dev/zero >>out/events.log
: >out/status.json
head -c 2000 out/state.h5 >out/state.h5.A1b2C3
"$greenbody" resume out --quiet >stdout 2>stderr
is 'zeros behind the rows: it is resumed' [ $? -eq 0 ]
rows out | cmp -s - whole.rows
result 'to the same bits' $?
is 'nothing temporary is left' [ ! -e out/state.h5.A1b2C3 ]
grep -qaF 'load' out/curve.csv && ! LC_ALL=C grep -qaP '\x00' out/curve.csv out/events.log
result 'and no zero' $?

echo "1..$tests"
exit $bad
