#!/bin/sh
# Packings of files as a user presses them: exported by this program, written by LAMMPS where it
# is installed, copied into the run directory; wrong files.
# Usage: import.sh GREENBODY PRESET_FOLDER
script=$(realpath "$0")
. "$(dirname "$0")/folder.sh"

run() { # preset and keys
    in_patience "$greenbody" run "$@" --quiet >stdout 2>stderr
}

refused() { # name, text of the line, file
    in_patience "$greenbody" run default structure.from="$3" --out refused \
        >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -e refused ] &&
        grep -q -- "$2" stderr
    result "$1" $?
}

same_rows() { # two run directories: the same curve but for the last columns' seconds
    "$greenbody" export "$1" --format csv --contacts one.c -o one.csv --force >stdout &&
        "$greenbody" export "$2" --format csv --contacts two.c -o two.csv --force >stdout &&
        tail -n +2 one.csv >one && tail -n +2 two.csv >two && cmp one two &&
        tail -n +2 one.c >one && tail -n +2 two.c >two && cmp one two
}

pressed() { # name, preset, keys...: exported in every format and pressed on
    what=$1
    shift
    rm -rf first
    is "$what" run "$@" --out first
    for format in extxyz lammps-dump lammps-data csv vtkhdf; do
        rm -rf "from-$format" "x.$format"
        "$greenbody" export first --format $format -o "x.$format" >stdout 2>stderr
        is "$what: pressed from $format" \
            run "$@" structure.from="x.$format" --out "from-$format"
        is "$what: $format gives the same run" same_rows from-extxyz "from-$format"
    done
}

short="numerics.fidelity=fast loading.unload_from="
# shellcheck disable=SC2086  # keys without blanks
{
    pressed 'one size' default particles.count=200 $short 'loading.until=3 MPa'
    pressed 'many sizes' p1-set2-lognormal particles.count=200 $short 'loading.until=3 MPa'
    pressed 'discs in motion' p2-v1 particles.count=200 loading.until=density=0.52
}

# --- the run directory is whole ---------------------------------------------------------------
is 'the packing is kept beside the preset' grep -q '^from *= *structure.csv' \
    from-csv/preset.ini
# of unequal particles, which a copy could mix up
long="p1-set2-lognormal structure.from=kept.csv loading.unload_from= numerics.fidelity=fast"
rm -rf first
run p1-set2-lognormal particles.count=200 loading.unload_from= 'loading.until=1 MPa' --out first
"$greenbody" export first --format csv -o kept.csv >stdout 2>stderr
# shellcheck disable=SC2086
is 'undisturbed' run $long 'loading.until=40 MPa' --out whole
begun() {
    [ -f stopped/curve.csv ] && [ "$(grep -c '^load' stopped/curve.csv)" -gt 3 ]
}
# shellcheck disable=SC2086
"$greenbody" run $long 'loading.until=40 MPa' numerics.threads=2 --quiet --out stopped \
    >stdout 2>stderr &
engine=$!
until_true begun
kill -TERM $engine 2>/dev/null
ended $engine
rm kept.csv
mkdir elsewhere
is 'a stopped run goes on without the file, from another folder' sh -c \
    "cd elsewhere && timeout $patience_s '$greenbody' resume ../stopped --quiet >../stdout 2>../stderr"
is 'to the same bits' same_rows whole stopped
in_patience "$greenbody" verify stopped >stdout 2>stderr
result 'and is verified' $?

# --- other programs ---------------------------------------------------------------------------
if command -v lmp >/dev/null; then
    printf '%s\n' 'units micro' 'atom_style sphere' 'boundary p p p' \
        'region box block -5 7 0 12 0 12' 'create_box 1 box' 'lattice sc 2.0' \
        'create_atoms 1 box' 'set type 1 diameter 1.8' 'set type 1 density 3.9' \
        'displace_atoms all random 0.05 0.05 0.05 7 units box' \
        'pair_style zero 2.0' 'pair_coeff * *' 'write_data lammps.data' \
        'dump d all custom 1 lammps.dump id xu yu zu radius' 'dump_modify d units yes' \
        'run 0' >in.lmp
    is 'LAMMPS writes a packing' sh -c 'lmp -in in.lmp -log none >lmp.out 2>&1'
    for file in lammps.data lammps.dump; do
        rm -rf lammps
        is "its $file is pressed" run default structure.from=$file loading.unload_from= \
            'loading.until=1 MPa' --out lammps
        is 'all of them' [ "$(grep -c '^[0-9]' lammps/structure.csv)" -eq \
            "$(awk '/ atoms$/ { print $1 }' lammps.data)" ]
    done
    is 'with particles of the size in a dump, which names its units' \
        grep -q '^diameter *= *1.8 um' lammps/preset.ini
else
    echo '# no LAMMPS here: its files are not tested'
fi

"$greenbody" export first --format csv -o again.csv >stdout 2>stderr
replicas() { # command and its options
    in_patience "$greenbody" "$@" structure.from=again.csv --out many >stdout 2>stderr
    result "$1: replicas of one packing are refused" $(($? != 2))
    is 'with the reason' grep -q 'again.csv: expected none for [234] cells' stderr
    is 'and nothing is written' [ ! -e many ]
}
replicas sweep p1-set2-lognormal --vary contact.mu=0.1,0.2 --replicas 2
replicas moduli p1-set2-lognormal --replicas 2
replicas strength p1-set2-lognormal --replicas 2
replicas yield p1-set2-lognormal --replicas 2
replicas card p1-set2-lognormal --replicas 4
replicas chart p1-set2-lognormal --seeds 3

# --- tilted cells -----------------------------------------------------------------------------
# Twice the cell of a packing, along x: in a box, and in cells of the same lattice of images
# with a tilt.  All are one infinite packing.
tilted='particles.count=200 loading.unload_from= numerics.precision=double'
# shellcheck disable=SC2086
run default $tilted 'loading.until=20 MPa' --out small
in_patience "$greenbody" export small --format csv -o small.csv >stdout 2>stderr
doubled() { # tilts xy, xz in edges of the small cell
    awk -F, -v xy="$1" -v xz="$2" '
        /^# cell/ { split($0, part, ": "); split(part[2], edge, " ")
            printf "# cell, nm: %.17g %s %s tilt xy xz yz, nm: %.17g %.17g 0\n", 2 * edge[1],
                edge[2], edge[3], xy * edge[1], xz * edge[1]
            print "x_nm,y_nm,z_nm,diameter_nm" }
        /^[0-9]/ { for (k = 0; k < 2; k++)
            printf "%.17g,%s,%s,%s\n", $2 + k * edge[1], $3, $4, $5 }' small.csv
}
doubled 0 0 >box.csv
doubled 1 0 >xy.csv
doubled 0 1 >xz.csv
same_points() { # the branch, step, density and pressures of two curves to 1e-9
    paste -d, one two | awk -F, '{ n++; for (k = 3; k <= 6; k++) {
        d = $k - $(k + 6); d = d < 0 ? -d : d; if (d > 1e-9 * ($k < 0 ? -$k : $k) + 1e-12) exit 1 }
        } END { exit n < 30 }'
}
points() { grep '^load' "$1/curve.csv" | head -n 60 | cut -d, -f1-6; }
for cell in box xy xz; do
    # shellcheck disable=SC2086
    is "the cell $cell is pressed" run default $tilted structure.from=$cell.csv \
        particles.count=400 'loading.until=30 MPa' --out "cell-$cell"
    points cell-box >one
    points "cell-$cell" >two
    is 'as the packing that it is' same_points
done
for cell in box xy xz; do
    # shellcheck disable=SC2086
    in_patience "$greenbody" pack default $tilted structure.from=$cell.csv \
        particles.count=400 --out "pack-$cell" >stdout 2>stderr
    result "the packing $cell is measured" $?
    # shellcheck disable=SC2016
    sed -n '/^coordination/,/^spans/p' stdout >"pack-$cell.txt"
    is 'with the contacts and clusters that it has' cmp -s pack-box.txt "pack-$cell.txt"
done
is 'with its tilts' grep -q '^# tilts xy xz yz, d: [1-9]' pack-xy/packing.csv
is 'its table has the tilts' grep -q '^# cell, d: .* tilt xy xz yz, d: [1-9]' cell-xy/structure.csv
in_patience "$greenbody" verify cell-xy >stdout 2>stderr
result 'a run in a tilted cell is verified' $?
is 'a tilted cell is sheared' run default structure.from=xy.csv \
    'loading.path=uniaxial to 20 MPa; shear xz to 2 %' --out sheared
for format in extxyz lammps-dump lammps-data vtkhdf csv; do
    in_patience "$greenbody" export sheared --format $format -o "sheared.$format" \
        >stdout 2>stderr
    rm -rf again
    is "the sheared cell as $format is pressed" run default structure.from="sheared.$format" \
        loading.unload_from= 'loading.until=30 MPa' --out again
    grep '^# cell' again/structure.csv | tr ' ' '\n' | grep '[0-9]' >two
    [ -s one ] && [ $format != extxyz ] || cp two one
    # a dump has the box around the cell, and its bounds rounded
    # a tilt of half an edge is that of either sign
    is 'with its cell' sh -c 'paste one two | awk "{ d = \$1 - \$2; n++; edge[n] = \$1
        if (n > 3) { l = edge[n < 6 ? 1 : 2]; d = d < 0 ? -d : d; d = d > l / 2 ? d - l : d }
        if (d * d > 1e-24) exit 1 } END { exit n != 6 }"'
done

# --- wrong input ------------------------------------------------------------------------------
rows() { # edge of the cell along x: a row of twelve, and two of them side by side
    printf '# cell, um: %s 40 40\nx_um,y_um,z_um,diameter_um\n' "$1"
    seq 12 | awk '{ print "1," 1 + $1 % 2 "," 3 * $1 ",2" }'
}
{ rows 40 && echo 1,2,3.5,2; } >deep.csv
rows 4 >narrow.csv
{ rows 40 && echo 1,1,one,2; } >word.csv
refused 'deep overlaps, with numbers' 'particles 1 and 13 by 0.75: must be at most 0.5' deep.csv
{
    printf '# cell, um: 3 3 3\nx_um,y_um,z_um,diameter_um\n'
    awk 'BEGIN { for (i = 0; i < 4000; i++) printf "%g,%g,%g,1\n", i % 16 / 16, int(i / 16) % 16 / 16, i / 4096 }'
} >collapsed.csv
refused 'a packing that has collapsed' 'the packing has collapsed' collapsed.csv
refused 'a narrow cell' 'a cell of 2 d along x' narrow.csv
sed 's/^# cell.*/& tilt xy xz yz, um: 1 2/' deep.csv >tilts.csv
refused 'a tilt too few' 'tilts.csv:1: 2 tilts of the cell: must be 3' tilts.csv
printf '2\nLattice="0 9 0 9 0 0 0 0 9" Properties=pos:R:3:radius:R:1\n1 1 1 1\n1 1 5 1\n' >turned.xyz
refused 'a turned cell' 'turned.xyz:2: Lattice: cell vectors must be (Lx 0 0)' turned.xyz
refused 'a word for a number' 'word.csv:15: z is one' word.csv
refused 'no file' 'absent.csv: No such file' absent.csv
refused 'no text' 'is not a text file: expected' "$greenbody"
in_patience "$greenbody" run p3-hertz-mu0 structure.from=deep.csv --out refused >stdout 2>stderr
is 'a die has no packing from a file' grep -q 'structure.from: must be empty' stderr

echo "1..$tests"
exit $bad
