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
    "$greenbody" run default particles.count=200 "loading.until=12 MPa" \
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
# a replica that stopped early is at another state: it is no part of the mean of ends
cp -r "run 1" stopped
sed -i 's/^seed *=.*/seed = 7/' stopped/preset.ini
sed -i 's/"state" : "done"/"state" : "stopped"/' stopped/status.json
sed -i '$d' stopped/curve.csv
"$greenbody" report "run 1" stopped -o early >stdout 2>stderr &&
    "$greenbody" report "run 1" -o alone >stdout 2>stderr
tail -n 1 early/tables/ends.csv | cut -d, -f3- >one
tail -n 1 alone/tables/ends.csv | cut -d, -f3- >two
[ "$(wc -c <one)" -gt 10 ] && cmp -s one two
result "ends without a run that stopped early" $?
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

# first page: results with errors, misfit, conditions; the laboratory file inside; everything
# from outside escaped
lab='lab <i>&|1.csv'
printf 'density,p_MPa,density_error\n0.30,2,0.01\n0.32,4,0.01\n0.5,900,0.01\n' >"$lab"
"$greenbody" report "run 1" "run 2" --data "$lab" -o with >stdout 2>stderr
result "a report with measured points" $?
first=$(sed -n '/^## Results/,/^## Figures/p' with/report.md)
has() { printf '%s\n' "$first" | grep -qE -- "$1"; }
has '^\| .* springback by volume from 2 MPa \| [0-9.]+ ± [0-9.]+ \| % \| 2 \| standard error'
result "springback with its error" $?
has '^\| .* RMS misfit to the laboratory file \| [0-9.]+ \| % of theoretical density \| 2 \| 2 of 3 measured points'
result "misfit to the points that are reached" $?
has '^\| .* alumina \| 200 spheres, d = 10 nm \| 2 \| 1, 2 \| rod, .* uniaxial to 12 MPa, unloading from 2 MPa \| fast'
result "conditions" $?
copy=$(sed -n 's/^[0-9a-f]*  \(data\/.*\)/\1/p' with/SHA256SUMS)
cmp -s "with/$copy" "$lab" && (cd with && sha256sum -c --quiet SHA256SUMS) >/dev/null 2>&1 &&
    grep -q "$(sha256sum <"$lab" | cut -d' ' -f1)" with/index.html
result "the laboratory file inside, with its checksum" $?
! grep -q 'lab <i>' with/index.html && grep -q 'lab &lt;i&gt;&amp;|1.csv' with/index.html &&
    grep -qF 'lab \<i\>&\|1.csv' with/report.md
result "names from outside are escaped" $?
! grep -qi "left out\|not in this report\|no data for" with/index.html with/report.md
result "nothing about what is missing" $?
sed -n '/^## Parameters/,/^## References/p' with/report.md >keys
grep -q '^| material.young | <i>E</i> | 382 | GPa | .* | P1 V |' keys &&
    ! grep -q "| loading.rate |\|| material.yield |\|| output\." keys
result "the keys in use, with symbol, unit and source" $?
grep -q '^| contact.bridge\\_length | .*<i>r</i><sub>ch</sub> | 0.008 | d | .* | P1 (2), V |' keys &&
    grep -q '^| contact.shear\\_strength | .*<sub>b</sub> | .* | P1 (4), (5), V |' keys &&
    grep -q '^| contact.bridge\\_radius | .* | deepest | .* | P1 II.A |' keys
result "with those of bridges" $?
sed -n '/^## References/,/^## Provenance/p' with/report.md >papers
grep -q "P1: .* Three-dimensional simulations of nanopowder .*88, 012209 (2013)" papers &&
    grep -q "R. W. Heckel, Density-pressure relationships .* (1961)" papers &&
    ! grep -q "Potyondy\|Hertz" papers
result "references in full, of the laws and equations in use" $?
missing=0
for tag in P1 P2 P3 Salmon; do # the last cell of a row has the sources
    if sed 's/.*| \([^|]*\) |$/\1/' keys | grep -q "$tag"; then
        grep -q "^[0-9]*\. .*$tag" papers || { echo "# $tag"; missing=1; }
    fi
done
result "and of every paper that a source of a key names" $missing
has '^\| .* relative density at 10 MPa .* standard error of 2 cells, itself known to 71 %'
result "the error of two cells with its own" $?
has 'rod, mu = 0.1, bridges from 0.008 d, attraction'
result "bridges" $?
"$greenbody" run default particles.count=200 "loading.until=2 MPa" loading.unload_from= \
    contact.bridge_length=1d numerics.fidelity=fast -q --out plain >stdout 2>stderr &&
    "$greenbody" report plain -o loose >stdout 2>stderr &&
    grep -q 'rod, mu = 0.1, no bridges, attraction' loose/report.md &&
    grep -q '^| contact.bridge\\_length .* | 1 | d |' loose/report.md &&
    ! grep -q 'contact.bridge_radius' loose/tables/keys.csv
result "and none" $?
"$greenbody" report "run 1" "run 2" --data "$lab" -o twice >stdout 2>stderr
same=0
for page in index.html report.md SHA256SUMS tables/results.csv tables/keys.csv; do
    grep -v 'runs of 1 scene' "with/$page" >one
    grep -v 'runs of 1 scene' "twice/$page" | cmp -s - one || { echo "# $page"; same=1; }
done
result "the same report again" $same
"$greenbody" report "run 1" -o single >stdout 2>stderr &&
    grep -q '"expected scatter of one cell"' single/tables/results.csv
result "one cell has its expected scatter" $?

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
