#!/bin/sh
# `greenbody yield` and `greenbody strength` as a user meets them.
# Usage: yield.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

refused() { # words of the message, then a command: status 2, one line, nothing on stdout
    words=$1
    shift
    "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ] &&
        grep -q -e "$words" stderr || {
        cat stderr
        return 1
    }
}

for command in yield strength; do
    is "$command: without --out" refused 'needs --out DIR' "$greenbody" $command default
    is "$command: without a preset" refused 'preset' "$greenbody" $command --out out
    is "$command: unknown preset" refused 'no-such' "$greenbody" $command no-such --out out
    is "$command: unknown option" refused 'colour' "$greenbody" $command default --colour \
        --out out
    is "$command: --at and --density" refused 'expected one of them' \
        "$greenbody" $command default --at '50 MPa' --density 0.5 --out out
    is "$command: --density" refused '--density' "$greenbody" $command default \
        --density x --out out
    is "$command: --at of every" refused '--at' "$greenbody" $command default \
        --at 'every 20' --out out
    is "$command: --at of a length" refused '--at' "$greenbody" $command default \
        --at '5 nm' --out out
    is "$command: --replicas" refused '--replicas 0: must be between 1 and 1000' \
        "$greenbody" $command default --replicas 0 --out out
    is "$command: --jobs" refused '--jobs' "$greenbody" $command default --jobs -1 --out out
    is "$command: bad value" refused 'contact.mu' "$greenbody" $command default \
        contact.mu=-1 --out out
    is "$command: in 2D" refused 'must be quasistatic and 3' "$greenbody" $command p2-v1 \
        --out out
    is "$command: in a die" refused 'must be quasistatic and 3' \
        "$greenbody" $command p3-hertz-mu0 --out out
    mkdir single
    touch single/preset.ini
    is "$command: in a run directory" refused 'holds a single run' \
        "$greenbody" $command default --out single
    rm -r single
done
is 'yield: --inside 1' refused '--inside 1: must be between 0 and 1' \
    "$greenbody" yield default --inside 1 --out out
is 'yield: --directions' refused '--directions 10: must be between 8 and 72, a multiple of 4' \
    "$greenbody" yield default --directions 10 --out out
is 'yield: --offset' refused '--offset 5: must be between 0.01 and 2 %' \
    "$greenbody" yield default --offset 5 --out out
is 'yield: density 1' refused '--density' "$greenbody" yield default --density 1 --out out
is 'refused commands leave nothing' [ ! -e out ]

strength() {
    "$greenbody" strength default particles.count=60 'structure.base=5 d' --at '30 MPa' \
        --jobs 1 --out out "$@" >stdout 2>stderr
}
is 'two cells are broken' strength --replicas 2
is 'files are written' [ -s out/strength.csv -a -s out/strength_curves.csv -a \
    -s out/strength.md -a -s out/scene.ini ]
cp out/strength.csv first.csv
is 'repeated, it says the same' strength --replicas 2
is 'and measures nothing' [ ! -s stderr ]
sed '/^#/d' first.csv >first && sed '/^#/d' out/strength.csv >second
is 'to the digit' cmp first second
is 'a third cell is added' strength --replicas 3
is 'alone' [ "$(grep -c 'cell-' stderr)" -eq 1 ]
is 'the figures are drawn' "$greenbody" plot out --figure strength -o strength.svg
is 'of both kinds' "$greenbody" plot out --figure strength-curves -o curves.svg
is 'a compact that is not there' refused 'expected 30' \
    "$greenbody" plot out --figure strength-curves --at '70 MPa' -o none.svg
echo "1..$tests"
exit $bad
