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
is 'a run may follow in the same place' "$greenbody" run default particles.count=200 \
    "loading.until=density = 0.25" loading.unload_from= --quiet --out out --force
is 'the packing is gone' [ ! -e out/packing.csv ]

echo "1..$tests"
exit $bad
