#!/bin/bash
# kill -9 at random moments, resumed each time, until the run is done: curve and state must be
# those of the undisturbed run, byte for byte apart from times; no file is lost or half
# written.  Signals that ask politely, locks and verify on the way.
# Usage: kill.sh GREENBODY PRESET_FOLDER SAME_STATE KILLS [SEED]
. "$(dirname "$0")/folder.sh"

same_state=$3
most=$4
RANDOM=${5:-1}

# The rows without their times; seconds are the 14th column.
rows() {
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13,15-
}

# Every file there is can be read: rows are whole, the state is one.
whole() { # directory
    [ ! -s "$1/curve.csv" ] || [ "$(tail -c 1 "$1/curve.csv" | od -An -c | tr -d ' ')" = '\n' ] ||
        return 1
    [ ! -e "$1/state.h5" ] || "$same_state" "$1" "$1" 2>stderr
}

# Runs that take some seconds, with checkpoints as often as can be.
quasistatic=(default particles.count=400 numerics.tolerance=3e-3 "loading.until=150 MPa"
    "loading.unload_from=20 MPa; 80 MPa")
dynamic=(p2-v1 particles.count=300 "loading.relax=0.005 ns" "loading.hold=0.005 ns"
    "loading.record=0.2 %" "loading.record_time=0.001 ns"
    "loading.until=density = 0.75" --yes)
# poured in seconds; killed before its first point it begins anew
die=(p3-hertz-mu0 particles.count=40 --yes)

# In the background, so that $! is the program itself.
begin() { # directory, kind
    local -n scene=$2
    "$greenbody" run "${scene[@]}" "output.checkpoint_every=0.1 s" --quiet --out "$1" \
        >stdout 2>stderr &
}

go_on() {
    "$greenbody" resume --quiet "$1" >stdout 2>stderr &
}

pause() { # up to $1 milliseconds
    sleep "$(awk -v r=$RANDOM -v m="$1" 'BEGIN { printf "%.3f", r / 32768 * m / 1000 }')"
}

# Status of $! after a random time: killed, unless it was done before.  After the last kill
# it is left alone.
killed() { # most milliseconds
    if [ "$kills" -lt "$left" ]; then
        pause "$1"
        kill -KILL $! 2>/dev/null
    fi
    ended $! 2>/dev/null
}

campaign() { # kind, kills
    local kind=$1 left=$2 kills=0 runs=0 from length
    from=$(date +%s%N)
    begin "whole-$kind" "$kind"
    ended $!
    is "$kind: the undisturbed run ends" [ $? -eq 0 ]
    length=$((($(date +%s%N) - from) / 1000000))
    rows "whole-$kind" >"whole-$kind.rows"
    while [ "$kills" -lt "$left" ]; do
        rm -rf broken
        begin broken "$kind"
        while killed $((length / 2 + 100)); [ $? -eq 137 ]; do
            kills=$((kills + 1))
            if ! whole broken; then
                result "$kind: whole files after kill $kills" 1
                return
            fi
            if [ -e broken/preset.ini ]; then
                go_on broken
            else # killed before there was a run
                rm -rf broken
                begin broken "$kind"
            fi
        done
        runs=$((runs + 1))
        if ! rows broken | cmp -s - "whole-$kind.rows" ||
            ! "$same_state" "whole-$kind" broken 2>stderr; then
            result "$kind: curve and state of the undisturbed run after $kills kills" 1
            return
        fi
    done
    result "$kind: $kills kills in $runs runs, same curve, same state" 0
    "$greenbody" verify broken >stdout 2>stderr
    is "$kind: verify repeats it" grep -qx equal stdout
}

for kind in quasistatic dynamic die; do
    campaign $kind "$most"
done

# --- asked politely -----------------------------------------------------------------------
stands() {
    grep -qs '^State:.T' "/proc/$engine/status"
}

gone() {
    ! grep -qs '^State:.[^Z]' "/proc/$engine/status"
}

stands_or_gone() {
    stands || gone
}

pressed_or_gone() {
    [ -e broken/curve.csv ] && [ "$(wc -l <broken/curve.csv)" -gt 20 ] || gone
}

# An engine that stands still in the middle of its run: it does not get through with it while
# it is looked at.  Begun anew where it was done before it was met.
catch() { # kind
    while :; do
        rm -rf broken
        begin broken "$1"
        engine=$!
        until_true pressed_or_gone
        kill -STOP $engine 2>/dev/null
        until_true stands_or_gone
        stands && return
        ended $engine
    done
}

for signal in INT:130 TERM:143; do
    catch quasistatic
    "$greenbody" resume broken >stdout 2>stderr
    is "a run under way is not resumed" [ $? -eq 2 ]
    "$greenbody" verify broken >stdout 2>stderr
    is "nor verified" [ $? -eq 2 ]
    kill -s "${signal%:*}" $engine
    kill -CONT $engine
    ended $engine
    is "${signal%:*} gives ${signal#*:}" [ $? -eq "${signal#*:}" ]
    grep -q "\"points\" : $(rows broken | sed 1d | wc -l)," broken/status.json
    result "and keeps every point" $?
    "$greenbody" resume --quiet broken numerics.threads=2 >stdout 2>stderr
    is "resume takes no other words" [ $? -eq 2 ]
    "$greenbody" resume --quiet broken >stdout 2>stderr
    is "resume ends it" [ $? -eq 0 ]
    rows broken | cmp -s - whole-quasistatic.rows && "$same_state" whole-quasistatic broken
    result "as if it had never stopped" $?
done

# --- what cannot go on --------------------------------------------------------------------
refused() { # name, pattern
    "$greenbody" resume broken >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -q "$2" stderr
    result "$1" $?
}
cp -r broken kept
sed -i 's/^mu = .*/mu = 0.3/' broken/preset.ini
refused 'a preset that was edited' 'preset.ini: was changed'
cp kept/preset.ini broken
head -c 5000 kept/curve.csv >broken/curve.csv
refused 'a curve that is cut' 'curve.csv: does not match the checkpoint'
cp kept/curve.csv broken
head -c 20000 kept/state.h5 >broken/state.h5
refused 'a state that is cut' 'state.h5'
cp kept/state.h5 broken
printf '\1\2\3\4' | dd of=broken/state.h5 bs=1 conv=notrunc 2>/dev/null \
    seek=$(($(wc -c <kept/state.h5) / 2))
refused 'a state that is damaged' 'state.h5'
rm -r broken
"$greenbody" resume broken >stdout 2>stderr
is 'a directory that is not there' [ $? -eq 2 ]
mkdir broken
refused 'a directory without a run' 'preset.ini'
rm -rf broken
"$greenbody" pack default particles.count=100 --out broken >stdout 2>stderr
refused 'the packing of pack' 'preset.ini\|no checkpoint'

echo "1..$tests"
exit $bad
