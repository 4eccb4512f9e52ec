#!/bin/sh
# A directory of many runs, watched: means with bands, the map, the runs; live.
# Usage: many.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

is_ascii() {
    ! screen | LC_ALL=C grep -q '[^ -~]'
}

sweep() { # words
    "$greenbody" sweep default particles.count=100 loading.until='200 MPa' \
        loading.unload_from= --vary 'contact.mu=0.1;0.3' --vary 'contact.alpha=0.24;0.4' \
        --out "$here/map" --quiet "$@" >"$here/out" 2>&1
}

sweep --replicas 2 --jobs 2
is "a sweep of 2 x 2 with two cells each" [ $? -eq 0 ]
"$greenbody" attach "$here/map" >"$here/out" 2>&1
is "without a terminal it is told how they stand" \
    grep -qx '8 runs: 8 done, 0 under way, 0 failed' "$here/out"
mkdir "$here/empty"
"$greenbody" attach "$here/empty" >"$here/out" 2>&1
is "a directory without runs is refused" [ $? -eq 2 ]

open_terminal
start attach "$here/map"
shows "attach shows the means" '1 Pressure against relative density: mean'
shows "how many runs there are" '8 runs: 8 done, 0 under way, 0 failed  100 %'
shows "what tells the groups apart" 'alpha = 0.4, contact.mu = 0.3, 2 cells'
keys 2
shows "2 shows the map" '2 Relative density over the varied'
shows "one key across" 'contact.alpha'
shows "values with their errors" ' 0\.[2-6][0-9]* +-0\.0[0-9]*'
shows "at a pressure of the table" 'density at 100 MPa,'
keys Left
shows "Left goes to a lower one, a round number" 'density at 90 MPa,'
keys 3
shows "3 lists the runs" '✓ done  *100 % *mu-0.1_alpha-0.24_seed-1'
term resize-window -x 60 -y 20
shows "at 60 x 20, too" '100 % *mu-0.1_alpha-0.24_seed-1'
keys 1
shows "with curves" 'p, MPa'
term resize-window -x 30 -y 10
shows "too small says so" 'needs 40 x 12'
term resize-window -x 80 -y 24
shows "and comes back" 'mean and standard error'

# --- more cells are computed while it is watched
sweep --replicas 3 --jobs 1 &
shows "new runs are seen" '12 runs: '
shows "until they are done" '12 runs: 12 done'
ended $!
shows "as cells of their groups" '3 cells'
leaves "closes"
sweep --replicas 3 --jobs 1 --at '37;130 MPa'
start attach "$here/map"
keys 2
shows "the map at the pressure of --at" 'density at 130 MPa,'
leaves "closes after it"
with='LC_ALL=C' start attach "$here/map"
shows "without UTF-8 it opens" 'mean and standard error'
keys 2
shows "shows the map" 'density at'
is "in ASCII" until_true is_ascii
leaves "closes, too"

cp -r "$here/map" "$here/lost"
start attach "$here/lost"
shows "a copy of it opens" 'mean and standard error'
rm -rf "$here/lost"
shows "when it is removed, that is told" 'lost: '
shows "over what was shown last" 'mean and standard error'
leaves "closes without it"

# --- more cells and a fit, started from the workbench
start default particles.count=100 loading.until=10MPa loading.unload_from=
shows "the workbench opens" '✓ done'
keys C
shows "a fit needs an experiment" 'needs measured data'
keys R
shows "R asks how many cells" 'Replicas of this scene'
keys C-u
keys -l 'three'
keys Enter
shows "which is a number" 'must be between 2 and 1000'
keys C-u
keys -l '3 0.002@100'
keys Enter
shows "a pressure without its unit is refused" 'as in 0.002@100MPa'
keys C-u
keys -l '3'
keys Enter
shows "their mean is a card, which lies over the plot" 'Result: replicas'
keys Escape
shows "so does their mean" 'mean of 3 cells'
told "the events say where they are" 'replicas: computed in'
printf 'p_MPa,density,density_error\n5,0.26,0.01\n10,0.28,0.01\n' >"$here/lab.csv"
keys e
shows "e asks for an experiment" 'Measured data over the plot'
keys -l "$here/lab.csv"
keys Enter
shows "which lies over the plot" 'measured, RMS misfit'
keys C
shows "C asks for the keys" 'Calibration to the measured'
shows "by their names on the screen" '│  mu,alpha  '
keys C-u
keys -l 'nuu'
keys Enter
shows "an unknown key is refused by name, in the dialog" 'nuu: no such key'
shows "and to the end of the line" 'as contact.mu'
mv "$here/lab.csv" "$here/gone.csv"
keys C-u
keys -l 'mu,alpha'
keys Enter
term resize-window -x 200 -y 60
shows "a failure of the fit is an event" 'No such'
is "without the name of the program" has_not 's: calibration: greenbody'
is "once, behind the one of its start" [ "$(screen | grep -c 's: calibration:')" -eq 2 ]
term resize-window -x 80 -y 24
until_true fits_80
mv "$here/gone.csv" "$here/lab.csv"
keys C
keys C-u
keys -l 'mu=0.05:0.4'
keys Enter
told "how far the fit is" 'round 1'
fitted() {
    [ -s "$(find "$here/state" -name calibration.csv)" ]
}
is "it ends with a table" until_true fitted
shows "and a card" 'Result: calibration'
leaves "closes"
fit=$(dirname "$(find "$here/state" -name calibration.csv)")
start attach "$fit"
shows "attach shows the fit" 'key contact.mu'
keys 3
shows "and its runs" 'full_1_mu-'
leaves "closes in the end"

echo "1..$tests"
exit "$bad"
