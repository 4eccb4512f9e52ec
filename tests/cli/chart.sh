#!/bin/sh
# `greenbody chart` as a user meets it.  Usage: chart.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

chart() { # more arguments: a small scene and a short plan
    "$greenbody" chart mine.ini --seeds 3 --at '20 MPa; 50 MPa' \
        --vary 'numerics.tolerance=0.05,0.02' --vary 'loading.step=0.5 %,1 %' \
        --reference 'loading.step=0.2 %' "$@" >stdout 2>stderr
}

refused() { # status 2, one line on stderr, nothing on stdout
    "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ]
}

rows() {
    grep -c '^[a-z]*,[0-9]' "$1"
}

sed -e 's/^count = .*/count = 200/' -e 's/^title = .*/title = mine  # kept/' \
    "$GB_PRESET_DIR/default.ini" >mine.ini
cp mine.ini before.ini

is 'without --out nothing is done' refused "$greenbody" chart mine.ini
is 'a key that is no setting' refused "$greenbody" chart mine.ini --vary contact.mu=0.1 \
    --out out
is 'a budget that is no time' refused "$greenbody" chart mine.ini --budget 10 --out out
is 'a seed without one after it' refused "$greenbody" chart mine.ini \
    structure.seed=18446744073709551615 --seeds 2 --out out
is 'one seed says nothing' refused "$greenbody" chart mine.ini --seeds 1 --out out
is 'and nothing is made' [ ! -e out ]

is 'a budget stops it in good order' chart --budget '1 ms' --out out
is 'and says how to continue' grep -q 'the same command continues' stdout
is 'nothing half measured is kept' [ "$(rows out/runs.csv)" -eq 0 ]
is 'two seeds first' chart --seeds 2 --out out
is 'all of them' [ "$(rows out/runs.csv)" -eq 12 ]
cp out/runs.csv first.csv
is 'a third one later' chart --out out
is 'to the end' [ "$(rows out/runs.csv)" -eq 18 ]
is 'what was measured is not measured again' sh -c \
    '[ "$(head -n 15 out/runs.csv | cksum)" = "$(cksum <first.csv)" ]'
is 'a row per setting' [ "$(rows out/chart.csv)" -eq 6 ]
is 'with the error at each pressure' grep -q ',error_20MPa,error_se_20MPa,scatter_20MPa' \
    out/chart.csv
is 'the command is kept' grep -q '^# command: greenbody chart mine.ini' out/chart.csv
is 'the table tells the reference' grep -q '^R ' stdout
is 'and the cells for a standard error' grep -q 'a standard error of 0.001' stdout
is 'the scene is not touched' cmp -s mine.ini before.ini
is 'another scene does not go on there' refused "$greenbody" chart mine.ini \
    contact.mu=0.3 --out out --at '20 MPa; 50 MPa' --seeds 3
is 'nor other pressures' refused "$greenbody" chart mine.ini --at '30 MPa' --seeds 3 \
    --out out

# 2^53 + 1, which no double is
large() {
    "$greenbody" chart mine.ini structure.seed=9007199254740993 --seeds 2 --at '20 MPa' \
        --vary 'numerics.tolerance=0.05,0.02' --reference 'loading.step=0.5 %' --out large \
        >stdout 2>stderr
}
is 'a seed above 2^53' large
is 'is found again for the table, with the next one' \
    [ "$(grep -c 'needs 2 seeds' stdout) $(grep -c 'evaluations  seeds' stdout)" = '0 1' ]
is 'keeps its value' [ "$(grep -c ',9007199254740993,0,' large/runs.csv)" -eq 3 ]
is 'as the next one does' [ "$(grep -c ',9007199254740994,0,' large/runs.csv)" -eq 3 ]
cp large/runs.csv large.csv
is 'read again' large
is 'it is the same cell' cmp -s large.csv large/runs.csv

# Step of the row that took least processor time here, for which a setting of few milliseconds
# is no sure thing; every error is below 1.
cheapest() {
    awk -F, '/^[a-z]*,[0-9]/ && $9 == 0 && $14 != "" && (!row++ || $13 < least) {
                 least = $13
                 step = $3
             }
             END { if (row == 5) printf "%g %%", 100 * step }' out/chart.csv
}

is 'the setting goes into a copy' chart --allow 1 --out out --write copy.ini
is 'that differs in its numbers only' sh -c "diff mine.ini copy.ini | grep '^[<>]' |
    grep -vqE '^[<>] (step|strain_part|relaxer|tolerance|cutoff|precision) = ' && exit 1; exit 0"
is 'and keeps the rest' grep -q '^title = mine  # kept' copy.ini
is 'with the cheapest step' grep -q "^step = $(cheapest)$" copy.ini
is 'another file is not replaced' refused "$greenbody" chart \
    mine.ini --seeds 3 --at '20 MPa; 50 MPa' --out out --write before.ini
is 'but the preset itself is' chart --allow 1 --out out --write mine.ini
is 'to the same' cmp -s mine.ini copy.ini

# Any quantity that a study reports.
quantity() { # name, more arguments: a small scene and three settings
    name=$1
    shift
    "$greenbody" chart mine.ini loading.unload_from= --quantity "$name" --jobs 2 --seeds 2 \
        --at '20 MPa' --vary 'numerics.tolerance=0.1' --reference 'loading.step=0.2 %' \
        --reference 'numerics.tolerance=0.02' "$@" >stdout 2>stderr
}

is 'the quantities have names' sh -c "'$greenbody' chart --quantity list >stdout 2>stderr"
is 'with unit and study' grep -q '^residual_stress  *MPa  *die ' stdout
is 'another name' refused "$greenbody" chart mine.ini --quantity moduli --out q
is 'lists the names' grep -q 'quantity = moduli: expected E, nu' stderr
is 'no preset is written with it' refused "$greenbody" chart mine.ini --quantity E --out q \
    --write new.ini
is 'nor a number of cells' refused "$greenbody" chart mine.ini --quantity E --out q \
    --standard-error 0.01
is 'a chart of densities uses one core' refused "$greenbody" chart mine.ini --jobs 2 --out q
is 'a key that is no axis' refused "$greenbody" chart mine.ini --quantity E --out q \
    --vary contact.mu=0.1
is 'a scene without it' refused "$greenbody" chart mine.ini --quantity residual_stress --out q
is 'a mark for what has none' refused "$greenbody" chart mine.ini --quantity heckel_K --out q \
    --at '20 MPa'
is 'a folder of a run' sh -c 'mkdir single && touch single/preset.ini'
is 'is none for a chart' refused "$greenbody" chart mine.ini --quantity E --out single
is 'nothing is made' [ ! -e q ]

is 'a budget stops a quantity' quantity E --out q --budget '1 ms'
is 'the cost comes first' [ "$(head -n 1 stdout | cut -d: -f1)" = '6 of 6 cells to measure' ]
is 'and says that it continues' grep -q 'the same command continues' stdout
is 'it promises no number' sh -c '! grep -q nan stdout q/E.csv'
is 'the same command ends it' quantity E --out q
is 'with a recommendation or none' grep -qE '^(cheapest|no) setting' stdout
is 'a row per setting' [ "$(grep -c '^E,GPa,' q/E.csv)" -eq 3 ]
is 'the reference first' [ "$(awk -F, '/^E,/ { print $5 $6; exit }' q/E.csv)" = 10 ]
is 'both cells of each' [ "$(awk -F, '/^E,/ && $7 == 2 && $8 == 0' q/E.csv | wc -l)" -eq 3 ]
is 'its command is kept' grep -q '^# command: greenbody chart mine.ini' q/E.csv
cp q/E.csv E.csv
is 'another quantity of the same cells' quantity nu --out q
is 'measures nothing' grep -q '^0 of 6 cells to measure' stdout
is 'and gives the same' sh -c '[ "$(grep ^E, q/E.csv)" = "$(grep ^E, E.csv)" ]'
is 'a figure of it' "$greenbody" plot q/E.csv --figure chart-quantity -o figure.svg
is 'of one file' refused "$greenbody" plot q --figure chart-quantity -o no.svg

echo "1..$tests"
exit $bad
