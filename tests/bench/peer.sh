#!/bin/bash
# Side by side, on one core and in one run: a step of the same 8000 spheres (Hertz, Mindlin
# with history, Coulomb) in LAMMPS and here.  Two tables: the periodic packing, moved by the
# relaxer in single precision; and the same spheres without what reaches across the faces,
# moved with LAMMPS's dashpots by the engine of the die, in double precision.
# Usage: peer.sh TIME_PACKING TIME_SPHERES [PHI]
# LAMMPS is Debian's package `lammps`; LMP names another build.
set -eu
time_packing=$1
time_spheres=$2
phi=${3:-0.64}
lmp=${LMP:-lmp}
decks=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
steps=800

command -v "$lmp" >/dev/null || {
    echo "skipped: $lmp is not installed (Debian: apt-get install lammps)"
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
export OMP_NUM_THREADS=1

quietly() {
    "$@" >"$work/log" 2>&1 || {
        tail -n 20 "$work/log" >&2
        exit 1
    }
}

# Processor time, which other work on the machine does not lengthen; that of the start goes
# away with the difference of two runs.
lammps_seconds() { # sides, steps
    quietly bash -c 'TIMEFORMAT=%U; time "$@" 2>&1' lammps "$lmp" -in "$decks/peer_time.lmp" \
        -log none -var data "$work/pack" -var sides "$1" -var steps "$2"
    tail -n 1 "$work/log"
}

compare() { # title, sides, program
    for _ in 1 2 3 4 5; do
        short=$(lammps_seconds "$2" $((steps / 8)))
        long=$(lammps_seconds "$2" "$steps")
        # the first row of the table, before the first step; NF tells it from counts
        awk -v seconds="$long $short" -v steps=$((steps - steps / 8)) '
            /^ *0 / && NF == 5 { touch = $2; virial = $3 }
            /^Loop time/ { n = $(NF - 1) }
            END { split(seconds, s, " ")
                  printf "lammps %.8g %.8g %.5f\n", touch, virial,
                         1e6 * (s[1] - s[2]) / steps / n }
            ' "$work/log"
        "$3" "$work/pack" 9 >"$work/here"
        awk '/^coordination/ { touch = $2 } /^virial/ { virial = $2 } /^step/ { us = $2 }
            END { printf "greenbody %.8g %.8g %.5f\n", touch, virial, us }' "$work/here"
    done >"$work/rounds"
    awk -v title="$1" '
        { touch[$1] = $2; virial[$1] = $3; us[$1, ++n[$1]] = $4 }
        function median(who,   i, j, t) {
            for (i = 1; i <= 5; i++)
                for (j = i + 1; j <= 5; j++)
                    if (us[who, j] < us[who, i]) {
                        t = us[who, i]; us[who, i] = us[who, j]; us[who, j] = t
                    }
            return us[who, 3]
        }
        function apart(a, b) { return (a > b ? a - b : b - a) / (b > 0 ? b : 1) }
        END {
            print title
            printf "%-10s %14s %14s %16s\n", "", "coordination", "virial", "us per sphere"
            for (who in n)
                printf "%-10s %14.6f %14.8g %16.4f\n", who, touch[who], virial[who], median(who)
            printf "ratio %.2f\n", median("lammps") / median("greenbody")
            # the dashpots differ, and LAMMPS counts what moves
            if (apart(touch["lammps"], touch["greenbody"]) > 1e-9 ||
                apart(virial["lammps"], virial["greenbody"]) > 1e-3) {
                print "not the same forces"; exit 1
            }
        }' "$work/rounds"
}

quietly "$lmp" -in "$decks/peer_pack.lmp" -log none -var phi "$phi" -var out "$work/pack"
echo "8000 spheres at a volume fraction of $phi, one core, processor time, medians of 5"
compare "periodic packing; here: single precision, moved by FIRE" p "$time_packing"
compare "open box; here: double precision, central differences, dashpots" s "$time_spheres"
