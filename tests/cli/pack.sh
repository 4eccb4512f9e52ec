#!/bin/sh
# `greenbody pack` as a user meets it.  Usage: pack.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

pack() { # more arguments: the small scene
    "$greenbody" pack default particles.count=300 "$@" >stdout 2>stderr
}

refused() { # arguments: status 2, one line on stderr, nothing on stdout
    pack "$@"
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ]
}

is 'a packing is made' pack --out out
for file in preset.ini packing.csv g.csv structure.json state.h5; do
    is "there is $file" [ -f "out/$file" ]
done
is 'and nothing else' [ "$(find out -type f | wc -l)" -eq 5 ]
is 'header of the packing' grep -qx 'x_d,y_d,z_d' out/packing.csv
is 'a row for each particle' [ "$(grep -c '^[0-9]' out/packing.csv)" -eq 300 ]
is 'header of g' grep -qx 'r_d,g' out/g.csv
is 'the table tells the coordination number' grep -q '^coordination   [34]\.' stdout
is 'one cluster' grep -q '"clusters" : 1,' out/structure.json
is 'numbers of JSON' sh -c '! grep -qE "e[-+]?[0-9]+\.|nan|inf" out/structure.json'

cp out/packing.csv first.csv
is 'it is not overwritten' refused --out out
is 'and is as it was' cmp -s out/packing.csv first.csv
is 'with --force it is replaced' pack structure.seed=2 --out out --force
is 'another seed, another packing' sh -c '! cmp -s out/packing.csv first.csv'
is 'the same seed again' pack --out out --force
is 'gives the same packing' cmp -s out/packing.csv first.csv
is 'without --out nothing is done' refused
is 'too dense' refused structure.density=0.7 --out dense
is 'says where it stopped' grep -q 'structure.density = 0.7: not reached' stderr
is 'and leaves nothing' [ ! -e dense ]
is 'in the plane' pack scene.dimension=2 structure.density=0.5 --out plane
is 'y is 0' awk -F, '/^[0-9]/ && $2 != 0 { bad = 1 } END { exit bad }' plane/packing.csv
percolation() { # more arguments: P1 Fig. 3
    "$greenbody" pack p1-fig3 "$@" >stdout 2>stderr
}

spans_both() { # particles, density: the structure of P1 Fig. 3 with so many discs
    percolation particles.count="$1" structure.density="$2" --out fig3 --force &&
        grep -qx 'spans along    x z ' stdout
}

no_both() {
    ! spans_both "$@"
}

is 'the number at which it percolates' percolation --percolation 2
is 'a row for each cell' grep -qx '69,599,0.522726' stdout
is 'and their mean' grep -q '^# mean [0-9.]* particles, density 0\.' stdout
is 'at that number the structure spans both axes' spans_both 599 0.5227261
is 'one disc less does not' no_both 598 0.5218535
is 'a table is no packing' refused --percolation 2 --out table
is 'cells are counted' refused --percolation 0
is 'and it says so' grep -q 'must be between 1 and' stderr
is 'one size is needed' refused particles.distribution=lognormal particles.count=2000 \
    --percolation 1
is 'and that is said' grep -q 'sought for mono' stderr
is 'a lattice does not grow' refused structure.kind=fcc particles.count=256 --percolation 1

die() { # more arguments: a small bed
    "$greenbody" pack p3-hertz-mu0 particles.count=40 die.diameter='24 um' \
        die.central='12 um' "$@" >stdout 2>stderr
}

die_refused() { # status 2, one line on stderr
    die "$@"
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ]
}

is 'a bed is poured' die --every '10 us' --out bed
is 'its density is told' grep -q '^density        0\.[45]' stdout
is 'the stages are told' grep -q 'at rest after' stderr
is 'with radii' grep -qx 'x_d,y_d,z_d,radius_d' bed/packing.csv
is 'states of the filling are kept' [ -f bed/snapshots/filling-000002.h5 ]
is 'it can be drawn' sh -c '"$0" plot bed --figure die-section >stdout' "$greenbody"
is '--every is for dies' refused --every '1 us' --out cell
is 'a time above 0' die_refused --every 0us --out no
is 'a die does not percolate' die_refused --percolation 1

is 'a run may follow in the same place' "$greenbody" run default particles.count=200 \
    "loading.until=density = 0.25" loading.unload_from= --quiet --out out --force
is 'the packing is gone' [ ! -e out/packing.csv ]

echo "1..$tests"
exit $bad
