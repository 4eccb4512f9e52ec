#!/bin/sh
# `greenbody bench` as a user meets it, with few particles.
# Usage: bench.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

# name, command: one line on stderr, nothing on stdout, status 2
refused() {
    what=$1
    shift
    in_patience "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ]
    result "$what" $?
}
bench() {
    in_patience "$greenbody" bench "$@" >stdout 2>stderr
}

bench particles.count=300 --csv
is 'the table' [ $? -eq 0 ]
cp stdout stored.csv
is 'four cells in a row' awk -F, '!/^#/ && NF != 4 { bad = 1 } END { exit bad || NR < 20 }' stored.csv
for row in 'evaluation and move on one core' '1000 particles on all cores' \
    'double precision on one core' 'many sizes on one core' \
    'planar dynamic scene on one core' 'die: Storakers with friction'; do
    is "row: $row" awk -F, -v row="$row" \
        '$1 == row && $2 > 0 && $4 > 0 { there = 1 } END { exit !there }' stored.csv
done
is 'same bits for every number of threads' grep -q '^same bits on one and all cores,1,' stored.csv

# beside a run that was ten times as fast
awk -F, -v OFS=, '$1 == "evaluation and move on one core" { $2 /= 10; $4 /= 10 } { print }' \
    stored.csv >fast.csv
bench particles.count=300 --compare fast.csv
is 'compared' [ $? -eq 0 ]
is 'slower is called worse' grep -q '^evaluation and move on one core .* worse$' stdout
is 'facts have no verdict' grep -qE '^particles +300 +300 +1.000 *$' stdout

is 'terms in turn' bench particles.count=300 --terms --csv
is 'with their spread' awk -F, 'NR > 1 && !($2 > 0 && $4 > 0) { bad = 1 }
    END { exit bad || NR != 7 }' stdout
is 'roofline' bench particles.count=300 --roofline --csv
is 'its share is one' awk -F, '$1 == "share of the roof reached" && $2 > 0 && $2 < 1 { there = 1 }
    END { exit !there }' stdout

refused 'a stored run of another scene' "$greenbody" bench particles.count=250 --compare stored.csv
refused 'no such file' "$greenbody" bench --compare missing.csv
printf 'terms,us_per_particle\nall,1\n' >other.csv
refused 'another table' "$greenbody" bench --compare other.csv
refused 'two tables' "$greenbody" bench --terms --roofline
refused 'compared as CSV' "$greenbody" bench --compare stored.csv --csv
refused 'no kernel of the counts' "$greenbody" bench --roofline numerics.precision=double

echo "1..$tests"
exit $bad
