#!/bin/sh
# Every benchmark prints its rows: here with few particles.
# Usage: benchmarks.sh TIME_CELLS TIME_TERMS TIME_CHECKPOINT TIME_DISCS TIME_DIE
set -u
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
export TMPDIR="$scratch"
out=$scratch/out
err=$scratch/err
tests=0
bad=0

is() { # name, command...
    name=$1
    shift
    tests=$((tests + 1))
    if "$@"; then
        echo "ok $tests $name"
    else
        echo "not ok $tests $name"
        sed 's/^/# /' "$out" "$err"
        bad=1
    fi
}
run() {
    "$@" >"$out" 2>"$err"
}
# Its last run: a row that begins so, with a positive number.
row() {
    awk -v row="$1" 'index($0, row) == 1 { rest = substr($0, length(row) + 1)
        split(rest, part, " "); if (part[1] > 0) { there = 1 } } END { exit !there }' "$out"
}
rows() {
    [ "$(wc -l <"$out")" -eq "$1" ]
}
refused() {
    run "$@"
    [ $? -eq 2 ] && [ "$(wc -l <"$err")" -eq 1 ] && [ ! -s "$out" ]
}

is cells run "$1" particles.count=300
for name in 'the scene on one core' '1000 particles on all cores' \
    'double precision on one core' 'many sizes on one core' memory; do
    is "row: $name" row "$name"
done
is sizes run "$1" 150,300,600
is 'a row for each size' row '       600'
is 'exponent' awk '/^exponent/ && $5 > 0.3 && $5 < 2 { there = 1 } END { exit !there }' "$out"
for list in 1000 1000,x 1000,1000 2000,1000 5,1000 ,; do
    is "refused: $list" refused "$1" "$list"
done
is 'refused: a die' refused "$1" scene.kind=die

is terms run "$2" particles.count=300
is 'six rows' rows 6
is 'without attraction' run "$2" particles.count=300 material.epsilon=0J
is 'three rows' rows 3

is checkpoint run "$3" particles.count=300
is 'row: engine blocked' row 'engine blocked'
is 'row: time to write' row 'time to write'
is 'nothing is left in TMPDIR' [ -z "$(ls -A "$scratch" | grep -v -e '^out$' -e '^err$')" ]

is discs run "$4" particles.count=300
is 'row: discs on one core' row 'discs on one core'
is die run "$5"
is 'row: Storakers with friction' row 'Storakers with friction'

echo "1..$tests"
exit $bad
