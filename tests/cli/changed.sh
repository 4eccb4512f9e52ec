#!/bin/bash
# Files of a run that another program changes, during the run or afterwards: neither verify
# nor resume takes them for the run's own.  A damaged checkpoint, and the one before it.
# Usage: changed.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

scene=(default particles.count=300 loading.step=0.02% "loading.until=60 MPa" loading.unload_from=
    output.checkpoint_every=0.1s)

# The rows without their times; seconds are the 14th column.
rows() {
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13,15-
}

has_rows() { # directory
    [ "$(grep -c '^load' "$1/curve.csv" 2>/dev/null || :)" -gt 5 ] 2>/dev/null
}

"$greenbody" run "${scene[@]}" --out whole --quiet
is 'the undisturbed run' [ $? -eq 0 ]
rows whole >whole.rows

# name, command...: what is done to a run under way
changes() {
    what=$1
    shift
    rm -rf out
    "$greenbody" run "${scene[@]}" --out out >stdout 2>stderr &
    pid=$!
    until_true has_rows out
    kill -STOP $pid # so that it happens between two points
    "$@"
    kill -CONT $pid
    ended $pid
    is "$what: the run goes on" [ $? -eq 0 ]
    for command in verify resume; do
        "$greenbody" $command out >stdout 2>stderr
        status=$?
        is "$what: $command refuses it" [ $status -ge 2 ]
        is 'with one line' [ "$(wc -l <stderr)" -eq 1 ]
        is 'that names the curve' grep -q 'curve.csv' stderr
    done
}

replaced() {
    sed -i 's/^load/LOAD/' out/curve.csv
}
removed() {
    rm out/curve.csv
}
cut_off() {
    truncate -s 100 out/curve.csv
}
overwritten() { # the same file, the same length
    printf 'x' | dd of=out/curve.csv bs=1 seek=300 conv=notrunc 2>/dev/null
}
curve_is_pipe() {
    rm out/curve.csv
    mkfifo out/curve.csv
}
changes 'an editor' replaced
changes 'rm' removed
changes 'truncate' cut_off
changes 'one byte' overwritten
changes 'a pipe' curve_is_pipe

# --- a curve that was changed afterwards ------------------------------------------------
rm -rf out
cp -a whole out
sed -i '300y/3/4/' out/curve.csv # digits of one row
cp out/curve.csv changed.csv
for command in verify resume; do
    "$greenbody" $command out >stdout 2>stderr
    is "$command refuses another curve" [ $? -eq 2 ]
    is 'with one line' [ "$(wc -l <stderr)" -eq 1 ]
    is 'that says why' grep -q 'curve.csv: was changed since the checkpoint' stderr
    is 'and leaves it alone' cmp -s out/curve.csv changed.csv
done

# --- a damaged checkpoint ---------------------------------------------------------------
# stopped under way, with two checkpoints
rm -rf out
"$greenbody" run "${scene[@]}" --out out >stdout 2>stderr &
pid=$!
until_true [ -e out/state-before.h5 ]
kill -TERM $pid
ended $pid
rm -rf lost
cp -r out lost
rm lost/state.h5
"$greenbody" resume lost >stdout 2>stderr
is 'where the last checkpoint is gone, the one before is named' [ $? -eq 2 ]
is 'with what is to be done' grep -q 'has no state.h5; state-before.h5 is whole: resume --before' stderr
truncate -s 3000 lost/state-before.h5
"$greenbody" resume lost >stdout 2>stderr
is 'where neither is whole, it is said what is lost' grep -q \
    'has no state.h5; nor is there a whole state-before.h5: without these two files resume starts' stderr
cp lost/state-before.h5 lost/state.h5
"$greenbody" resume lost >stdout 2>stderr
is 'nor if both are damaged' grep -q 'not a complete HDF5 file; nor is there a whole' stderr
cp out/state.h5 out/state.h5.AB12cd # of a writer that was killed
truncate -s 3000 out/state.h5
"$greenbody" resume out >stdout 2>stderr
is 'a damaged checkpoint is refused' [ $? -eq 2 ]
is 'with one line' [ "$(wc -l <stderr)" -eq 1 ]
is 'that names the one before' grep -q 'state-before.h5 is whole: resume --before' stderr
is 'what a killed writer left is gone' [ ! -e out/state.h5.AB12cd ]
"$greenbody" resume --before out >stdout 2>stderr
is 'from there it goes on' [ $? -eq 0 ]
rows out | cmp -s - whole.rows
result 'to the same curve' $?
rm -f out/state-before.h5
"$greenbody" resume --before out >stdout 2>stderr
is 'without one it says so' grep -q 'has no state-before.h5' stderr

# --- links ------------------------------------------------------------------------------------
for file in curve.csv events.log; do
    rm -rf linked
    cp -a whole linked
    printf 'mine\n' >target
    mv linked/$file linked/real
    ln -s "$here/target" linked/$file
    "$greenbody" resume linked >stdout 2>stderr
    is "a link as $file is refused" [ $? -eq 3 ]
    is 'with its name' grep -q "$file: cannot be opened" stderr
    is 'and not written through' [ "$(cat target)" = mine ]
done

# --- found before anything is written, and before there is anything to repeat ---------------
in_patience "$greenbody" run "${scene[@]}" 'loading.changes=5 contact.mu=0.2; 9 contact.bridge_length=1 d' \
    --quiet --out none >stdout 2>stderr
[ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -e none ] &&
    grep -q 'loading.changes: .*friction are there from the start' stderr
result 'a change that no run can take is refused at the start' $?
in_patience "$greenbody" run default particles.count=150 'loading.until=60 MPa' \
    'loading.unload_from=20 MPa' 'loading.changes=195 contact.mu=0.3' --quiet --out late \
    >stdout 2>stderr
[ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ "$(grep -c 'on an unloading branch' late/events.log)" -eq 1 ]
result 'one that only the run can find is one line and one event' $?
rm whole/state*.h5
"$greenbody" verify whole >stdout 2>stderr
[ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -q 'whole: there is no checkpoint yet' stderr
result 'verify without a checkpoint says so' $?

echo "1..$tests"
exit $bad
