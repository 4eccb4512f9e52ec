#!/bin/sh
# `greenbody papers` as a user meets it: the page, a call that goes on where another was killed,
# printed numbers in figures, wrong input.
# Usage: papers.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"
export GB_DATA_DIR="$presets/../assets/data"

papers() { # more arguments: eight tiny runs of P1 Fig. 5
    "$greenbody" papers --fast --only P1-fig5 --count 100 --cells 2 "$@" >stdout 2>stderr
}

refused() { # name, what the line must say, command: status 2, one line, nothing left behind
    name=$1
    says=$2
    shift 2
    in_patience "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -q -e "$says" stderr &&
        [ ! -s stdout ] && [ ! -e out ]
    result "$name" $?
}

# --- the page ----------------------------------------------------------------------------
papers --jobs 1 --out one
is 'it ends with status 0' [ $? -eq 0 ]
is 'an estimate comes first' grep -q '^estimated: about .* 8 runs' stderr
is 'a directory per experiment and run' [ -f one/P1-fig5/diameter-38nm_seed-2/curve.csv ]
is 'every run is done' [ "$(grep -c ',done,$' one/runs.csv)" -eq 8 ]
is 'the page counts them' grep -q '^Runs done: 8 of 8' one/papers.md
is 'a row has the number here, the printed one and a verdict' grep -qE \
    '^\| Fig. 5 \| density at 100 MPa \| 38 nm \| 0\.[45][0-9]* ± 0\.[0-9]* \| 0.496 \|  \| 2 \| (within|off)' \
    one/papers.md
is 'laws of the paper are compared, too' grep -q '^| section II.B .*within error' one/papers.md
is 'other papers are not' sh -c '! grep -q "^| .*P2-\|^## P2" one/papers.md'
is 'kept states are read' grep -q '^| .*share of particles with 12 contacts.*within error' one/papers.md
is 'figures are there' [ "$(grep -c '^!\[P1 ' one/papers.md)" -eq "$(find one -name '*.png' | wc -l)" ]
is 'with the printed numbers' grep -q '0\.387' one/P1-fig5.csv
is 'the table has a row per comparison' [ "$(wc -l <one/papers.csv)" -gt 12 ]
is 'the densities of the table are those of the runs' awk -F, '
    FILENAME ~ /papers.csv/ { if ($1 == "P1-fig5-9.7nm") want = $7; next }
    FNR == 1 { done = 0; p0 = 0 }
    /^#/ || /^branch/ { next }
    $1 == "load" && !done { if ($7 >= 100) { sum += d0 + (100 - p0) / ($7 - p0) * ($3 - d0)
                                           n++; done = 1 } p0 = $7; d0 = $3 }
    END { d = sum / n - want; exit !(n == 2 && d < 1e-12 && d > -1e-12) }' \
    one/papers.csv one/P1-fig5/diameter-9.7nm_seed-*/curve.csv

# --- structures alone --------------------------------------------------------------------
"$greenbody" papers --fast --only P1-fig3 --out grown >stdout 2>stderr
is 'structures are grown for their number' [ $? -eq 0 ]
is 'where they percolate, beside the one of the paper' grep -qE \
    '^\| Fig. 3 .* 6[0-9]{2} ± [0-9]+ \| 600 .*\| 20 \| within error' grown/papers.md

# --- killed, and called again ------------------------------------------------------------
"$greenbody" papers --fast --only P1-fig5 --count 100 --cells 2 --jobs 1 --out two \
    >stdout 2>stderr &
one_is_done() {
    grep -qs '"state" *: *"done"' two/P1-fig5/*/status.json
}
until_true one_is_done
kill -KILL $!
ended $! 2>/dev/null
is 'its workers stop by themselves' until_true none_works two
before=$(grep -ls '"state" *: *"done"' two/P1-fig5/*/status.json | wc -l)
is 'killed with some runs done and some not' [ "$before" -ge 1 ] && [ "$before" -lt 8 ]
# shellcheck disable=SC2046  # names without blanks
touch -d 2001-01-01 $(grep -ls '"state" *: *"done"' two/P1-fig5/*/status.json)
papers --jobs 3 --out two
is 'the second call ends with status 0' [ $? -eq 0 ]
is 'finished runs are not repeated' \
    [ "$(find two/P1-fig5 -name status.json ! -newermt 2002-01-01 | wc -l)" -eq "$before" ]
is 'the results are equal to the bit' cmp one/papers.csv two/papers.csv
is 'and the figures drawn from them' cmp one/P1-fig5.csv two/P1-fig5.csv
papers --out two
is 'a third call repeats nothing' grep -q '^8 runs, 8 of them done before' stderr

# --- printed numbers over other figures --------------------------------------------------
"$greenbody" plot one/P1-fig5 --figure size-effect --paper >stdout 2>stderr
is 'plot --paper adds them' grep -q '10\.9' stdout
"$greenbody" plot one/P1-fig5/diameter-16nm_seed-1 --figure densification --paper \
    >stdout 2>stderr
is 'of the scenes that are shown only' [ $? -eq 2 ]
is 'and says so' grep -q -e '--paper: the papers print no number' stderr

# --- wrong input -------------------------------------------------------------------------
refused 'no directory' '--out' "$greenbody" papers
refused 'an unknown experiment' 'expected P1' "$greenbody" papers --only P4 --out out
refused 'a word too many' 'options only' "$greenbody" papers P1 --out out
refused 'too few particles' '--count 3: must be between 50' "$greenbody" papers --count 3 --out out
refused 'no particles' '--count 0: must be between 50' "$greenbody" papers --count 0 --out out
refused 'no cells' '--cells 0: must be between 1' "$greenbody" papers --cells 0 --out out
refused 'fewer than none' '--cells -1: must be between 1' "$greenbody" papers --cells -1 --out out
refused 'an experiment that this size leaves out' 'no cells' \
    "$greenbody" papers --fast --only P2-v5 --out out
in_patience "$greenbody" papers --only P1-fig5 --count 120 --cells 2 --out one >stdout 2>stderr
is 'runs of another size are not mixed in' [ $? -eq 2 ]
is 'and named' grep -q 'holds a run of other parameters' stderr
echo "1..$tests"
exit $bad
