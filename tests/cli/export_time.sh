#!/bin/sh
# Time of the processor that `greenbody export` takes for 100,000 moving particles and their
# contacts: under 2 s in every format.
# Usage: export_time.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

"$greenbody" run p2-3d-v1 particles.count=100000 'loading.relax=0.0005 ns' \
    'loading.hold=0.0002 ns' 'loading.rate=100000 1/us' 'loading.until=density = 0.302' \
    --quiet --out run >stdout 2>stderr
is 'a run of 100,000 particles' [ $? -eq 0 ]
for format in extxyz lammps-dump lammps-data csv vtkhdf; do
    (
        "$greenbody" export run --format $format --contacts contacts -o particles &&
            times >time
    ) >stdout 2>stderr
    is "$format" [ $? -eq 0 ]
    # the second line, "0m0.98s 0m0.31s": user and system of children
    seconds=$(sed -n '2s/[ms]/ /gp' time | awk '{ print 60 * ($1 + $3) + $2 + $4 }')
    is "$format: $seconds s are under 2 s" awk -v s="$seconds" 'BEGIN { exit !(s > 0 && s < 2) }'
    rm -f contacts particles time
done

echo "1..$tests"
exit $bad
