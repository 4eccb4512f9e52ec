#!/bin/bash
# A disk that is full, of every size until there is room: each command that writes gives status
# 3, one line that names the file, and nothing half written; what was there before is whole.
# The disk is a small one in memory, in a name space of its own.
# Usage: full.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/../common/own_disk.sh"
. "$(dirname "$0")/folder.sh"

mkdir disk || exit 1
mount -t tmpfs -o size=4k none disk || exit 1
trap 'end_engines; umount "$here/disk"; rm -rf "$here"' EXIT

room() { # KiB
    mount -o "remount,size=${1}k" disk
}

small=(default particles.count=200 "loading.until=5 MPa" loading.unload_from=
    numerics.fidelity=fast)
"$greenbody" run "${small[@]}" --quiet --out whole >stdout 2>stderr
is 'a run elsewhere' [ $? -eq 0 ]

rows() {
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13
}
rows whole >whole.rows

# Names that only a replacement under way has.
leftovers() {
    find disk -regextype posix-extended -regex '.*\.([A-Za-z0-9]{6}|tmp)' \
        ! -name '*.csv' ! -name '*.ini' ! -name '*.log' ! -name '*.json' | grep -q .
}

# Every size until it passes; with each failure the check of this kind of command.
ever_larger() { # name, check, command...
    local name=$1 check=$2 size=4 failures=0 status
    shift 2
    while [ $size -le 65536 ]; do
        find disk -mindepth 1 -delete
        room $size
        printf 'kept\n' >disk/kept
        "$@" >stdout 2>stderr
        status=$?
        if [ $status -eq 0 ]; then
            is "$name: fails $failures times, passes with $size KiB" [ $failures -gt 0 ]
            return
        fi
        failures=$((failures + 1))
        if [ $status -ne 3 ] || [ "$(wc -l <stderr)" -ne 1 ] ||
            ! grep -q '^greenbody: .*disk/.*[Nn]o space' stderr || leftovers ||
            [ "$(cat disk/kept)" != kept ] || ! $check; then
            echo "# status $status with $size KiB"
            find disk | sed 's/^/# /'
            result "$name: a clear line and nothing half written" 1
            return
        fi
        size=$((size * 4))
    done
    result "$name: passes at all" 1
}

# shellcheck disable=SC2317  # called by its name
# Once there is room again the run goes on to the undisturbed end.
goes_on() {
    room 65536
    [ ! -e disk/run/preset.ini ] || {
        "$greenbody" resume --quiet disk/run >stdout 2>stderr &&
            rows disk/run | cmp -s - whole.rows
    }
}

ever_larger run goes_on "$greenbody" run "${small[@]}" "output.checkpoint_every=0.1 s" \
    --quiet --out disk/run
ever_larger 'run with states along it' goes_on "$greenbody" run "${small[@]}" \
    "output.snapshots_at=every 5" --quiet --out disk/run
ever_larger pack true "$greenbody" pack default particles.count=200 --out disk/pack
for kind in csv svg pdf png; do
    ever_larger "plot to $kind" true "$greenbody" plot whole --figure densification \
        -o disk/figure.$kind
done
if "$greenbody" snapshot whole -o trial.png >stdout 2>stderr; then
    ever_larger snapshot true "$greenbody" snapshot whole -o disk/picture.png
fi
ever_larger report true "$greenbody" report whole -o disk/report

# Of the commands that tell their progress the last line is the error.
last_line() {
    "$greenbody" "$@" 2>lines
    local status=$?
    tail -n 1 lines >&2
    return $status
}
ever_larger sweep true last_line sweep "${small[@]}" --vary "contact.mu=0.1;0.2" \
    --replicas 1 -j 1 --out disk/sweep
printf 'p_MPa,density,density_error\n5,0.26,0.01\n10,0.28,0.01\n' >lab.csv
ever_larger calibrate true last_line calibrate "${small[@]}" particles.count=100 \
    "loading.until=10 MPa" --data lab.csv --free contact.mu=0.05:0.4 --replicas 3 -j 1 \
    --out disk/fit
sed 's/^count = .*/count = 100/' "$GB_PRESET_DIR/default.ini" >mine.ini
ever_larger chart true last_line chart mine.ini --seeds 2 --at '5 MPa' \
    --vary 'numerics.tolerance=0.05,0.02' --reference 'loading.step=0.5 %' \
    --out disk/chart
ever_larger stability true "$greenbody" stability --out disk/stability

echo "1..$tests"
exit $bad
