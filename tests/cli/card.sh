#!/bin/sh
# `greenbody card` as a user meets it.  Usage: card.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

refused() { # status 2, one line on stderr, nothing on stdout
    "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ]
}

is 'without --out nothing is done' refused "$greenbody" card p1-set2-9.7nm
is 'two cells say nothing' refused "$greenbody" card p1-set2-9.7nm --replicas 2 --out card
is 'densities ascend' refused "$greenbody" card p1-set2-9.7nm --densities 0.5,0.4 --out card
is 'and are numbers' refused "$greenbody" card p1-set2-9.7nm --densities 0.4,x --out card
is 'few directions leave no failure line' refused "$greenbody" card p1-set2-9.7nm \
    --directions 8 --out card
is 'ways of pressing are named' refused "$greenbody" card p1-set2-9.7nm --compacts up --out card
is 'weights of flow are not negative' refused "$greenbody" card p1-set2-9.7nm --flow=-1 --out card
is 'a die has no card' refused "$greenbody" card p3-hertz-mu0 --densities 0.5,0.6 --out card
mkdir there
is 'an existing folder is kept' refused "$greenbody" card p1-set2-9.7nm --out there
is 'nothing is made' [ "$(ls -A | grep -c card)" -eq 0 ]

is 'a card of two densities' sh -c '"$0" card default particles.count=60 structure.base=auto \
    --densities 0.45,0.55 --replicas 3 --directions 15 --out two >stdout 2>stderr' "$greenbody"
is 'says nothing of numbers that are not there' [ "$(cat stdout two/* | grep -aciw nan)" -eq 0 ]
is 'but shows a dash' grep -q 'at the same p_z -$' stdout
is 'a surface that misses its points is named' \
    [ "$(grep -c ': the surface is ' stdout)" -eq "$(grep -c '^# density' two/card.csv)" ]
echo "1..$tests"
exit $bad
