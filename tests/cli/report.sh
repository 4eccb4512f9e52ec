#!/bin/sh
# `greenbody report`: what lies in the folder, that the page finds it, and what is refused.
# Usage: report.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

refused() { # name, status, part of the line, arguments
    name=$1
    want=$2
    part=$3
    shift 3
    "$greenbody" report "$@" >stdout 2>stderr
    status=$?
    [ "$status" -eq "$want" ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -qF -- "$part" stderr
    result "$name" $?
}

for seed in 1 2; do
    "$greenbody" run default particles.count=200 "loading.until=5 MPa" \
        loading.unload_from="2 MPa" numerics.fidelity=fast structure.seed=$seed -q \
        --out "run $seed" >stdout 2>stderr || { cat stderr; exit 1; }
done

"$greenbody" report "run 1" "run 2" -o out >stdout 2>stderr && [ ! -s stderr ] && [ ! -s stdout ]
result "a report" $?
missing=0
for file in index.html report.md preset.ini tables/density.csv tables/ends.csv \
    tables/runs.csv runs/1-preset.ini runs/2-curve.csv figures/densification.svg \
    figures/densification.png figures/densification.pdf figures/densification.csv; do
    [ -s "out/$file" ] || { echo "# no $file"; missing=1; }
done
result "its files" $missing
missing=0
sed -n 's/.*src="\([^"]*\)".*/\1/p; s/.*href="\([^"]*\)".*/\1/p' out/index.html >names
while read -r name; do
    [ -s "out/$name" ] || { echo "# $name leads nowhere"; missing=1; }
done <names
[ "$(wc -l <names)" -gt 5 ] || missing=1
result "what the page names is there" $missing
! grep -q "http" out/index.html
result "nothing comes from elsewhere" $?
grep -q "^| run " out/report.md && grep -q "2 runs of 1 scene" out/report.md
result "Markdown says the same" $?
cmp -s "out/runs/1-curve.csv" "run 1/curve.csv"
result "curves as they are" $?
"$greenbody" run out/runs/1-preset.ini -q --out again >stdout 2>stderr &&
    cut -d, -f1-13 again/curve.csv | grep -v '^#' >one &&
    cut -d, -f1-13 "run 1/curve.csv" | grep -v '^#' >two && cmp -s one two
result "the preset makes the run again" $?

refused "never over something" 2 "out: exists" "run 1" -o out
refused "no folder" 3 "cannot be made" "run 1" -o no/where/out
refused "no run" 2 "no preset.ini" nothing -o new
refused "no OUT" 2 "-o OUT" "run 1"
# a disk that fills up: no file may grow beyond 8 blocks
(ulimit -f 8; "$greenbody" report "run 1" -o full >stdout 2>stderr)
[ $? -eq 3 ] && [ "$(wc -l <stderr)" -eq 1 ]
result "a full disk" $?
[ -z "$(ls -d full* no new* out.* 2>/dev/null)" ]
result "nothing is left by what was refused" $?

echo "1..$tests"
exit "$bad"
