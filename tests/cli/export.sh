#!/bin/sh
# `greenbody export` as a user meets it: kept states as a trajectory, one state, files that
# LAMMPS reads where it is installed, wrong input.
# Usage: export.sh GREENBODY PRESET_FOLDER
script=$(realpath "$0")
. "$(dirname "$0")/folder.sh"

refused() { # name, command: status 2, one line on stderr, nothing left behind
    name=$1
    shift
    in_patience "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ] && [ ! -e out ]
    result "$name" $?
}

"$greenbody" run default particles.count=200 numerics.fidelity=fast loading.unload_from= \
    'loading.until=10 MPa' 'output.snapshots_at=2 MPa; 5 MPa' --quiet --out run \
    >stdout 2>stderr
is 'a run with two kept states' [ $? -eq 0 ]
export_run() {
    "$greenbody" export run "$@" >stdout 2>stderr
}

is 'all states' export_run --format extxyz --all -o all.xyz
is 'are frames of one file' [ "$(grep -c '^Lattice=' all.xyz)" -eq 3 ]
is 'of all particles' [ "$(grep -c '^X ' all.xyz)" -eq 600 ]
is 'one state' export_run --format csv --at 'p=5 MPa' --contacts contacts.csv -o one.csv
is 'has a row per particle' [ "$(grep -c '^[0-9]' one.csv)" -eq 200 ]
is 'contacts are of its particles' awk -F, '
    /^[0-9]/ { n++; if ($2 < 1 || $2 > 200 || $3 < 1 || $3 > 200) bad = 1 }
    END { exit bad || n < 200 }' contacts.csv
# the mean of equal particles is the pressure of the cell, which the head names as p along z
is 'its stress is that of the cell' awk -F, '
    /^#.* p [0-9]/ { sub(/.* p /, ""); p = $0 + 0; next }
    /^[0-9]/ { n++; s += $9 } END { s /= n; exit !((s - p) ^ 2 < (1e-6 * p) ^ 2) }' one.csv
is 'a dump with contacts' export_run --format lammps-dump --all --contacts c.dump -o p.dump
is 'has the frames of both' sh -c \
    '[ "$(grep -c "^ITEM: TIMESTEP" p.dump)" -eq 3 ] && [ "$(grep -c "^ITEM: TIMESTEP" c.dump)" -eq 3 ]'
is 'a data file' export_run --format lammps-data -o p.data
is 'a state file alone' "$greenbody" export run/state.h5 --format lammps-data -o alone.data
if command -v lmp >/dev/null; then
    printf '%s\n' 'units nano' 'atom_style sphere' 'boundary p p p' 'read_data p.data' \
        'compute all all property/atom diameter' 'compute d all reduce ave c_all' 'pair_style zero 1.0' \
        'pair_coeff * *' 'thermo_style custom step atoms lx lz c_d' \
        'thermo_modify format float %.12g' 'run 0' >in.lmp
    is 'LAMMPS reads it' sh -c 'lmp -in in.lmp -log none >lmp.out 2>&1'
    is 'with count, edges and diameters' awk '
        /xlo xhi/ { x = $2 } /zlo zhi/ { z = $2 }
        NR != FNR && $2 == 200 && NF == 5 {
            good = ($3 - x) ^ 2 < 1e-10 && ($4 - z) ^ 2 < 1e-10 && ($5 - 10) ^ 2 < 1e-10 }
        END { exit !good }' p.data lmp.out
else
    echo '# no LAMMPS here: its reading of the files is not tested'
fi

# --- every kind of run in every format, read back by other programs ----------------------------
python=python3
for other in python3 /usr/bin/python3; do
    "$other" -c 'import h5py' 2>/dev/null && python=$other
done
for other in python3 /usr/bin/python3; do
    "$other" -c 'import ase.io, h5py' 2>/dev/null && python=$other
done
read_by_lammps() { # name: its data file, and over it its dump, as LAMMPS has them
    ends='p p p'
    grep -q 'BOUNDS.*ff ff ff' "$1.lammps-dump" && ends='f f f'
    frame=$(sed -n '/TIMESTEP/{n;p;q}' "$1.lammps-dump")
    moving=
    grep -q 'ITEM: ATOMS.* vx' "$1.lammps-dump" && moving='vx vy vz'
    fields='id x y z radius vx vy vz omegax omegay omegaz'
    # comm_modify and the cutoff: a box of a few large particles has no ghost without
    printf '%s\n' 'units nano' 'atom_style sphere' 'atom_modify sort 0 0' "boundary $ends" \
        "read_data $1.lammps-data" "pair_style zero $2" 'pair_coeff * *' \
        "comm_modify cutoff $3" 'run 0' \
        "write_dump all custom $1-0.back $fields modify format float %.17g" \
        "read_dump $1.lammps-dump $frame x y z $moving box yes replace yes" \
        "write_dump all custom $1-1.back $fields modify format float %.17g" >in.lmp
    lmp -in in.lmp -log none >lmp.out 2>&1
}
formats_agree() { # name, cutoff and skin of LAMMPS
    for format in extxyz lammps-dump lammps-data; do
        "$greenbody" export "$1" --format $format --contacts "$1-c.$format" \
            -o "$1.$format" >stdout 2>stderr
        is "$1: $format" [ $? -eq 0 ]
    done
    back=
    if command -v lmp >/dev/null; then
        is "$1: LAMMPS reads data and dump" read_by_lammps "$1" "$2" "$3"
        back="$1-0.back $1-1.back"
    fi
    # shellcheck disable=SC2086
    "$python" "$(dirname "$script")/read_export.py" "$1/state.h5" "$1" $back >stdout 2>stderr
    status=$?
    [ $status -eq 77 ] && echo '# no h5py or no ASE here: their reading of the files is not tested'
    [ $status -eq 0 ] || [ $status -eq 77 ]
    result "$1: text formats read back, all numbers equal" $?
}
tables_agree() { # name, run directory
    is "$1: a grid of particles, one of contacts" "$greenbody" export "$2" --format vtkhdf \
        --contacts "$2-c.vtkhdf" -o "$2.vtkhdf"
    "$greenbody" export "$2" --format csv --contacts "$2-c.csv" -o "$2.csv"
    "$python" "$(dirname "$script")/read_vtkhdf.py" "$2.vtkhdf" "$2-c.vtkhdf" "$2.csv" \
        "$2-c.csv" >stdout 2>stderr
    status=$?
    [ $status -eq 77 ] && echo '# no h5py here: its reading of the files is not tested'
    [ $status -eq 0 ] || [ $status -eq 77 ]
    result "$1: read back, all numbers equal" $?
}
kind() { # name, arguments of run...
    what=$1
    shift
    "$greenbody" run "$@" --quiet --out "$what" >stdout 2>stderr
    is "$what: a run" [ $? -eq 0 ]
    tables_agree "$what" "$what"
    formats_agree "$what" "${cutoff:-10}" "${reach:-20}"
}
tables_agree 'quasi-static' run
formats_agree run 10 20
kind sizes p1-set2-lognormal particles.count=150 loading.unload_from= 'loading.until=3 MPa'
kind planar default scene.dimension=2 particles.count=150 loading.unload_from= \
    'loading.until=density = 0.5'
kind sheared default particles.count=150 numerics.fidelity=reference \
    'loading.path=isotropic to 3 MPa; shear xz to 2 %'
kind dynamic p2-v1 particles.count=100 'loading.relax=0.005 ns' 'loading.hold=0.005 ns' \
    'loading.until=density = 0.6'
kind dynamic-sizes p2-v1 particles.count=60 particles.distribution=lognormal \
    'loading.relax=0.005 ns' 'loading.hold=0.005 ns' 'loading.until=density = 0.6'

# --- a series of VTKHDF files ------------------------------------------------------------------
is 'a series of VTKHDF files' export_run --format vtkhdf --all --contacts s-c.vtkhdf -o s.vtkhdf
is 'has a file for each state and a list' sh -c \
    '[ "$(ls s-000[012].vtkhdf s.vtkhdf.series | wc -l)" -eq 4 ] && [ ! -e s.vtkhdf ] &&
     [ ! -e s-0003.vtkhdf ] && [ "$(ls s-c-000[012].vtkhdf s-c.vtkhdf.series | wc -l)" -eq 4 ]'
"$python" "$(dirname "$script")/read_series.py" s.vtkhdf.series all.xyz >stdout 2>stderr
status=$?
[ $status -eq 77 ] && echo '# no h5py or no ASE here: their reading of the series is not tested'
[ $status -eq 0 ] || [ $status -eq 77 ]
result 'the series has the frames of the trajectory' $?
is 'tables of all states' export_run --format csv --all --contacts t-c.csv -o t.csv
is 'the last but one is that of the second mark' cmp t-0001.csv one.csv
is 'with its contacts' cmp t-c-0001.csv contacts.csv
is 'data files of all states' export_run --format lammps-data --all -o t.data
is 'one of the last' cmp t-0002.data p.data
if command -v pvpython >/dev/null; then
    pvpython --force-offscreen-rendering "$(dirname "$script")/read_paraview.py" \
        s.vtkhdf.series all.xyz >stdout 2>stderr
    result 'ParaView shows the series' $?
else
    echo '# no ParaView here: its reading of the series is not tested'
fi
rm s-0000.vtkhdf
refused 'a series of which a file exists' "$greenbody" export run --format vtkhdf --all -o s.vtkhdf
is 'nothing of it is written' [ ! -e s-0000.vtkhdf ]
is '--force replaces the series' export_run --format vtkhdf --all --force -o s.vtkhdf
is 'all of it' [ -e s-0000.vtkhdf ]

cutoff=10000 reach=20000
kind die p3-storakers-m0.2-mu0.05 particles.count=40 die.diameter='24 um' 'die.central=20 um' \
    'material.yield=150 MPa' numerics.fidelity=fast 'loading.until=5 MPa'

# --- along a run ---------------------------------------------------------------------------------
live_run() {
    "$greenbody" run default particles.count=200 numerics.fidelity=fast loading.unload_from= \
        'loading.until=10 MPa' 'output.snapshots_at=2 MPa; 5 MPa' "$@" --quiet --out live \
        >stdout 2>stderr
}
for format in extxyz lammps-dump; do
    is "$format along a run" live_run output.export=$format --force
    export_run --format $format --all --contacts live-c.$format --force -o live.$format
    contacts=$(ls live/trajectory-contacts.*)
    is 'has the frames of its kept states' sh -c \
        "cmp -n \$(stat -c %s live/trajectory.$format) live.$format live/trajectory.$format"
    is 'and their contacts' sh -c \
        "cmp -n \$(stat -c %s $contacts) live-c.$format $contacts"
    is 'two of them' [ "$(grep -c 'Lattice=\|ITEM: ATOMS' live/trajectory.$format)" -eq 2 ]
done
is 'VTKHDF along a run' live_run output.export=vtkhdf --force
is 'has a file for each state' [ -e live/snapshots/p-5MPa.vtkhdf ]
is 'and no trajectory of the run before' sh -c '! ls live/trajectory* 2>/dev/null'
export_run --format vtkhdf --at 'p=5 MPa' --contacts live-c.vtkhdf -o live.vtkhdf
is 'as export writes it' sh -c \
    'cmp live.vtkhdf live/snapshots/p-5MPa.vtkhdf &&
     cmp live-c.vtkhdf live/snapshots/p-5MPa-contacts.vtkhdf'
refused 'nothing that is kept' "$greenbody" run default output.export=csv --quiet --out out

# --- wrong input -------------------------------------------------------------------------
refused 'no run' "$greenbody" export --format csv -o out
refused 'no format' "$greenbody" export run -o out
refused 'an unknown format' "$greenbody" export run --format xyz -o out
is 'which lists the others' grep -q 'expected extxyz, lammps-dump' stderr
refused 'no file' "$greenbody" export run --format csv
refused 'no such state' "$greenbody" export run --format csv --at 'p=1 GPa' -o out
refused 'a directory without a run' "$greenbody" export . --format csv -o out
refused 'a file that exists' "$greenbody" export run --format csv -o one.csv
is 'is left as it was' [ "$(grep -c '^[0-9]' one.csv)" -eq 200 ]
refused 'one name for both' "$greenbody" export run --format csv --contacts out -o out
for name in state.h5 preset.ini curve.csv events.log status.json trajectory.extxyz; do
    refused "$name of a run" "$greenbody" export run --format csv --force -o run/$name
    refused 'for contacts' "$greenbody" export run --format csv --force --contacts \
        run/$name -o out
done
ln -s run/state.h5 link
refused 'a link to one' "$greenbody" export run --format csv --force -o link
kept=$(ls run/snapshots | head -1)
refused 'a kept state' "$greenbody" export run --format csv --force -o "run/snapshots/$kept"
refused 'by a figure' "$greenbody" plot run --figure densification --force -o run/curve.csv
"$greenbody" verify run >stdout 2>stderr
is 'the run is whole' [ $? -eq 0 ]
(
    ulimit -f 1
    export_run --format csv -o large.csv
    [ $? -eq 3 ] && grep -q 'File too large' stderr
)
result 'a file beyond the size limit is an error' $?
is 'and leaves nothing' [ -z "$(ls | grep large)" ]
is '--force replaces it' export_run --format csv --force -o one.csv

echo "1..$tests"
exit $bad
