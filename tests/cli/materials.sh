#!/bin/sh
# Materials by name.  Usage: materials.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

scene='default particles.count=300 loading.until=1MPa loading.unload_from='

run() { # directory, more words
    out=$1
    shift
    # shellcheck disable=SC2086  # words of the scene
    "$greenbody" run $scene "$@" --quiet --out "$out" >stdout 2>stderr
}

# status 2, one line on stderr, nothing on stdout
refuses() { # command...
    "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ]
}

value() { # key of [material], value, directory
    grep -qx "$1 = $2" "$3/preset.ini"
}

# The rows without their times; seconds are the 14th column.
same_rows() {
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13,15- >one
    grep -v '^#' "$2/curve.csv" | cut -d, -f1-13,15- | cmp -s one -
}

is 'a run of yttria' run yttria material=yttria
is 'its name is kept' value name yttria yttria
is 'its modulus is kept' value young '179.8 GPa' yttria
is 'its density is kept' value density '5020 kg/m3' yttria
is 'its attraction is kept' value epsilon '1783 kB' yttria
is 'the contacts stay' grep -qx 'alpha = 0.24' yttria/preset.ini
run alumina
is 'another curve than that of alumina' sh -c '! cmp -s yttria/curve.csv alumina/curve.csv'

run by-keys material.young='179.8 GPa' material.poisson=0.299 material.d0='0.473 nm' \
    material.epsilon='1783 kB'
is 'the same curve as by the keys one by one' same_rows yttria by-keys

repeats() { # without the file: the run has all keys
    GB_PRESET_DIR=$here/none "$greenbody" run yttria/preset.ini --quiet --out again \
        >stdout 2>stderr && same_rows yttria again
}
is 'the run repeats without the material' repeats

is 'a key behind it' run behind material=yttria material.young='200 GPa'
is 'counts' value young '200 GPa' behind
is 'one in front' run front material.young='200 GPa' material=yttria
is 'does not' value young '179.8 GPa' front
is 'one behind two materials' run twice material=copper young='100 GPa' material=iron
is 'belongs to the last' value young '211.4 GPa' twice
is 'as option' run option --set material=copper
is 'it is the same' value name copper option

# Every command that takes keys.
pack() {
    "$greenbody" pack default particles.count=300 material=yttria --out packing >stdout 2>stderr
}
is 'of a packing' pack
is 'its preset has it' value name yttria packing
sweep() {
    # shellcheck disable=SC2086
    "$greenbody" sweep $scene material=yttria --vary contact.mu=0.1,0.2 --out sweep \
        >stdout 2>stderr
}
is 'of a sweep' sweep
is 'both runs of it have it' [ "$(grep -lrx --include=preset.ini 'name = yttria' sweep | wc -l)" -ge 2 ]
grid() {
    # shellcheck disable=SC2086
    "$greenbody" sweep $scene loading.until=20MPa --vary material=alumina,yttria \
        --vary contact.mu=0.1,0.3 --out grid >stdout 2>stderr
}
is 'materials are varied' grid
is 'each has its runs' value density '5020 kg/m3' "$(ls -d grid/material-yttria_mu-0.3*)"
is 'and its rows' grep -q '^[0-9]*,yttria,0\.3,' grid/sweep.csv
labelled() {
    "$greenbody" plot grid --figure densification -o grid.csv >stdout 2>stderr &&
        grep -qx '# group 1: 1 runs, material.name = alumina, contact.mu = 0.1' grid.csv
}
is 'the name alone tells them apart in a figure' labelled
other_axis() {
    "$greenbody" plot grid --figure sweep --pressure '5 MPa' -o map.csv >stdout 2>stderr &&
        grep -q '^contact.mu,density' map.csv
}
is 'what follows from it is no axis' other_axis
names_have_no_range() {
    # shellcheck disable=SC2086
    refuses "$greenbody" sweep $scene --design sobol:4 --vary material=a:b --out wrong &&
        grep -q 'material=a:b: expected in a grid' stderr
}
is 'names have no range' names_have_no_range
of_law() {
    "$greenbody" law hertz material=yttria --at h=0.01 >stdout 2>stderr &&
        "$greenbody" law hertz young='179.8 GPa' poisson=0.299 --at h=0.01 | cmp -s - stdout
}
is 'of a law' of_law
family() {
    "$greenbody" law hertz --vary material=alumina,yttria --at h=0.01 >stdout 2>stderr &&
        grep -q '^alumina,' stdout && grep -q '^yttria,' stdout
}
is 'of a family of curves' family

is 'an unknown name' refuses "$greenbody" run default material=yttira --out wrong
is 'is answered with those there are' grep -q \
    'material=yttira: no such material; must be one of NiAl, alumina, copper' stderr
is 'and nothing is written' [ ! -e wrong ]
is 'also of a packing' refuses "$greenbody" pack default material=yttira --out wrong

mkdir -p config/greenbody/presets/materials
cat >config/greenbody/presets/materials/glass.ini <<END
[material]
name = soda-lime glass
young = 70 GPa
poisson = 0.22
density = 2500 kg/m3
d0 = 0.4 nm
n_d0_cubed = 1.4142135623730951
epsilon = 600 kB
END
is 'one of the own folder' run glass material=glass
is 'is found by its name' value name 'soda-lime glass' glass
cp config/greenbody/presets/materials/glass.ini here.ini
is 'a file' run file material=here.ini
is 'is found by its path' value young '70 GPa' file
echo '[contact]' >>here.ini
is 'one with another group' refuses "$greenbody" run default material=./here.ini --out wrong
is 'is told where and what' grep -q 'here.ini: \[contact\]: a material has' stderr
is 'nothing is written of it' [ ! -e wrong ]

listed() { # name: with its values and its file
    "$greenbody" params --materials >stdout 2>stderr && grep -q "^$1  .* GPa .*$1.ini\$" stdout
}
for name in alumina yttria zirconia titania NiAl nickel iron copper \
    microcrystalline-cellulose polymer-binder glass; do
    is "$name is listed" listed "$name"
done
is 'with what is guessed' grep -q '^alumina .*  yield, hardening  ' stdout
is 'as Markdown' sh -c '"$0" params --materials --markdown | grep -q "^| .yttria. | 179.8 GPa |"' \
    "$greenbody"
cp here.ini config/greenbody/presets/materials/broken.ini
is 'a broken one does not hide the others' listed yttria
is 'and is told' grep -q '^broken .*broken.ini: \[contact\]' stdout
is 'the help names them' sh -c '"$0" --help | grep -qx "  yttria"' "$greenbody"
completes() { # line, candidate
    "$greenbody" --complete run default "$1" | cut -f1 | grep -qx "$2"
}
is 'the key is completed' completes mat 'material='
is 'the name is completed' completes material=yt 'material=yttria'

echo "1..$tests"
exit "$bad"
