#!/bin/sh
# A named pipe where a file of the program should be: nothing waits for its other end, and one
# line says what is wrong.
# Usage: pipes.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

export XDG_STATE_HOME="$here/state"
mkdir -p state/greenbody
hang=60 # far more than any command here takes

run() { # directory
    "$greenbody" run default particles.count=200 'loading.until=50 MPa' loading.unload_from= \
        numerics.fidelity=fast output.snapshots_at='2 MPa' -q --out "$1" >stdout 2>stderr
}

pipe() { # file: in place of what is there
    rm -f "$1"
    mkfifo "$1"
}

# name, expected status, command: ends, and where it fails one line names the file
ends() {
    name=$1
    expected=$2
    shift 2
    timeout "$hang" "$@" >stdout 2>stderr </dev/null
    status=$?
    [ $status -eq "$expected" ] &&
        { [ $status -eq 0 ] || { [ "$(wc -l <stderr)" -eq 1 ] && grep -q "$file" stderr; }; }
    good=$?
    [ $good -eq 0 ] || echo "# status $status, expected $expected"
    result "$name" $good
}

run whole || exit 1
# file, statuses of attach, resume, verify, plot, fit, report, export
while read -r file attach resume verify plot fit report export; do
    rm -rf out page states.xyz
    cp -a whole out
    pipe "out/$file"
    ends "$file: attach" "$attach" "$greenbody" attach out
    ends "$file: verify" "$verify" "$greenbody" verify out
    ends "$file: plot" "$plot" "$greenbody" plot out --figure densification
    ends "$file: fit" "$fit" "$greenbody" fit out
    ends "$file: report" "$report" "$greenbody" report out -o page
    ends "$file: export" "$export" "$greenbody" export out --format extxyz -o states.xyz
    ends "$file: resume" "$resume" "$greenbody" resume out -q
    rm -rf out
done <<'TABLE'
preset.ini 2 2 2 2 2 2 0
curve.csv 2 2 2 2 2 2 0
events.log 0 2 0 0 0 0 0
status.json 2 0 0 0 0 0 0
state.h5 0 2 2 0 0 0 2
state-before.h5 0 0 0 0 0 0 0
TABLE

# --- other files with a known name ------------------------------------------------------------
mkdir -p config/greenbody/presets
file=screen.ini
pipe config/greenbody/screen.ini
ends 'settings of the screen' 2 "$greenbody" --diagnose
rm config/greenbody/screen.ini
file=workbench.log
pipe state/greenbody/workbench.log
ends 'the log' 0 "$greenbody" --diagnose
is 'which says that nothing is logged' \
    grep -q '^log .*nothing is logged: .*workbench.log: is not a regular file' stdout
file=typed
pipe config/greenbody/presets/typed.ini
ends 'a preset by its name' 2 "$greenbody" run typed -o out
pipe typed.ini
ends 'a preset by its path' 2 "$greenbody" run ./typed.ini -o out
file=typed.png
pipe typed.png
ends 'a picture' 2 "$greenbody" run --from typed.png -o out
rm typed.png typed.ini
"$greenbody" run /dev/stdin -q -o piped <whole/preset.ini >stdout 2>stderr
is 'a preset on standard input' [ $? -eq 0 ]
# shellcheck disable=SC2002  # a pipe
cat whole/preset.ini | "$greenbody" run /dev/stdin -q -o shell >stdout 2>stderr
is 'also through a pipe of the shell' [ $? -eq 0 ]

# --- functions of GLib that wait ---------------------------------------------------------------
grep -rn 'g_file_get_contents\|g_key_file_load_from_file' "$(dirname "$presets")/src" \
    --include='*.c' >waiting
is 'files are read by file.h' [ ! -s waiting ]
[ ! -s waiting ] || sed 's/^/# /' waiting

echo "1..$tests"
exit $bad
