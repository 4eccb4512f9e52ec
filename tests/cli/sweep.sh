#!/bin/sh
# `greenbody sweep` as a user meets it: the same tables for any number of workers, restarts
# that do what is missing, signals, wrong input.
# Usage: sweep.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

sweep() { # more arguments: four tiny runs
    "$greenbody" sweep p1-nobridge-38nm particles.count=100 structure.base=auto \
        'loading.until=5 MPa' 'loading.unload_from=5 MPa' numerics.fidelity=fast \
        --vary 'contact.mu=0.1;0.3' --replicas 2 --at '2;5 MPa' "$@" >stdout 2>stderr
}

refused() { # name, command: status 2, one line on stderr, nothing left behind
    name=$1
    shift
    in_patience "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ] && [ ! -e out ]
    result "$name" $?
}

# --- workers and restarts ----------------------------------------------------------------
sweep --jobs 1 --out one
is 'a sweep ends with status 0' [ $? -eq 0 ]
is 'a row per point, branch and pressure' [ "$(grep -c '^[12],0' one/sweep.csv)" -eq 6 ]
is 'both replicas count' grep -q '^2,0.3,load,5,2,0\.' one/sweep.csv
is 'a row per run' [ "$(grep -c ',done,$' one/runs.csv)" -eq 4 ]
is 'a directory per run' [ -f one/mu-0.1_seed-2/curve.csv ]
sweep --jobs 3 --out three
is 'the table does not depend on the workers' cmp one/sweep.csv three/sweep.csv
is 'nor does the list of runs' cmp one/runs.csv three/runs.csv

rm -r one/mu-0.3_seed-1
touch -d 2001-01-01 one/*/curve.csv
sweep --out one
is 'only what is missing is done again' \
    [ "$(find one -name curve.csv -newermt 2002-01-01)" = one/mu-0.3_seed-1/curve.csv ]
is 'and the table is the same' cmp one/sweep.csv three/sweep.csv
sweep --replicas 3 --out one
is 'more replicas add to what is there' \
    [ "$(find one -name curve.csv -newermt 2002-01-01 | wc -l)" -eq 3 ]
is 'and count' grep -q '^2,0.3,load,5,3,0\.' one/sweep.csv
sweep --replicas 9 --until-se 0.9@5MPa --jobs 1 --out one
is 'replicas end when the error is small enough' \
    [ "$(find one -name curve.csv | wc -l)" -eq 8 ]

# --- commas, semicolons and a short key -------------------------------------------------------
two_values() { # key=values
    "$greenbody" sweep p1-nobridge-38nm particles.count=50 structure.base=auto 'loading.until=0.1 MPa' \
        loading.unload_from= --vary "$1" --out commas >stdout 2>stderr
}
is 'values between commas' two_values mu=0.1,0.2
is 'are as many runs' [ "$(find commas/mu-0.[12]_seed-1 -name curve.csv | wc -l)" -eq 2 ]
is 'the same between semicolons' two_values 'contact.mu=0.1; 0.2'
is 'are the same runs' grep -q '^2 runs, 2 of them done before' stderr

# --- words as values -------------------------------------------------------------------------
"$greenbody" sweep p1-nobridge-38nm particles.count=50 structure.base=auto 'loading.until=0.1 MPa' \
    loading.unload_from= --vary 'material.name=a/b;ab;a b' --out words >stdout 2>stderr
is 'words that differ in signs only' [ $? -eq 0 ]
is 'have directories of their own' [ "$(find words -name curve.csv | wc -l)" -eq 3 ]
is 'with those words' [ "$(cat words/*/preset.ini | grep -cx 'name = \(a/b\|ab\|a b\)')" -eq 3 ]
awk 'BEGIN { for (i = 0; i < 100000; i++) printf "[" }' >words/name-ab_seed-1/status.json
"$greenbody" attach words >stdout 2>stderr
is 'attach survives a status that nests' [ $? -eq 0 ]
is 'and does not call that run live' grep -q '3 runs: 2 done, 0 under way' stdout

# --- runs that are done and fall short --------------------------------------------------------
short() { # keys...
    "$greenbody" sweep p1-nobridge-38nm particles.count=50 structure.base=auto loading.unload_from= \
        --replicas 2 "$@" >stdout 2>stderr
}
short 'loading.until=1 MPa' --out reached
is 'where all is reached, nothing is told' sh -c '! grep -q "missed a goal" stderr reached/sweep.csv'
short 'loading.until=1 MPa' numerics.max_evaluations=1 --out unrelaxed
is 'points out of equilibrium are told' grep -q 'missed a goal .*equilibrium: 2 (unrelaxed/runs.csv)' stderr
is 'with their number' \
    [ "$(grep -c ',done,".*[0-9]* of [0-9]* points are not in equilibrium"' unrelaxed/runs.csv)" -eq 2 ]
is 'and in the table of means' grep -q '^# runs that missed a goal .*: 2 (runs.csv)' unrelaxed/sweep.csv
short 'loading.until=20 MPa' 'loading.step=2 %' --out exceeded
is 'so are those that are exceeded' \
    [ "$(grep -c ',done,"exceeded: loading.until = 20 MPa by' exceeded/runs.csv)" -eq 2 ]
short 'loading.until=100 GPa' 'material.young=10 GPa' numerics.fidelity=fast --out unreached
is 'so are goals' [ "$(grep -c ',done,"not reached: loading.until = 100 GPa' unreached/runs.csv)" -eq 2 ]

# --- designs and sensitivities -----------------------------------------------------------
design() {
    "$greenbody" sweep p1-nobridge-38nm particles.count=100 structure.base=auto \
        'loading.until=5 MPa' numerics.fidelity=fast loading.unload_from= \
        --design "$1" --vary mu=0.1:0.4 --vary contact.alpha=0.2:0.5 \
        --replicas 3 --at '5 MPa' --out design >stdout 2>stderr
}
design sobol:8
is 'a design ends with status 0' [ $? -eq 0 ]
is 'and has its points' [ "$(grep -c ',load,5,3,' design/sweep.csv)" -eq 8 ]
is 'a row of sensitivities per key' \
    [ "$(grep -c '^load,5,density,contact\.\(mu\|alpha\),' design/sensitivity.csv)" -eq 2 ]
is 'with an error each' awk -F, '/^load,5,density/ && !($6 > 0 && $8 > 0) { exit 1 }' \
    design/sensitivity.csv
is 'said to people' grep -q '^  contact.alpha  .* +- ' stdout
touch -d 2001-01-01 design/*/curve.csv
design sobol:10
is 'a longer design adds points' \
    [ "$(find design -name curve.csv -newermt 2002-01-01 | wc -l)" -eq 6 ]
refused 'too few points for a quadratic' "$greenbody" sweep default --design sobol:5 \
    --vary contact.mu=0.1:0.4 --vary contact.alpha=0.2:0.5 --out out
refused 'a design without ranges' "$greenbody" sweep default --design sobol:8 --out out
refused 'a range with a count in a design' "$greenbody" sweep default --design sobol:8 \
    --vary contact.mu=0.1:0.4:3 --out out

# --- figures over a sweep ----------------------------------------------------------------
plot() {
    "$greenbody" plot "$@" >stdout 2>stderr
}
plot three --figure unloading
is 'a sweep can be plotted' [ "$(grep -c '^# group [12]: 2 runs, contact.mu' stdout)" -eq 2 ]
plot three --figure sweep --pressure '5 MPa'
is 'against the varied key' [ "$(grep -c '^0\.[13],0\.' stdout)" -eq 2 ]
is 'as the table has it' awk -F, '
    NR == FNR { if ($3 == "load" && $4 == 5) want[$2] = $6; next }
    /^0/ { n++; d = $2 - want[$1]; if (d > 1e-9 || d < -1e-9) bad = 1 }
    END { exit bad || n != 2 }' three/sweep.csv stdout
plot three/mu-0.1_seed-1 --figure sweep
is 'nothing varied, nothing drawn' [ $? -eq 2 ]
plot three --figure continuum
is 'the continuum theory predicts other geometries' \
    grep -q 'theory_uniaxial_MPa.*theory_isotropic_MPa' stdout
plot three/mu-0.1_seed-1 --figure continuum
# from the same law: the uniaxial prediction is the curve itself, the isotropic one lower
is 'from the uniaxial curve' awk -F, '
    /^#/ { next }
    !seen { for (i = 1; i <= NF; i++) at[$i] = i; seen = 1; next }
    { uniaxial = $at["theory_uniaxial_MPa"]; d = $at["density_theory_uniaxial"]
      isotropic[$at["density_theory_isotropic"]] = $at["theory_isotropic_MPa"] }
    uniaxial != "" { n++; last = uniaxial; end = d }
    END { for (d in isotropic) if (d != "" && d <= end && isotropic[d] > below)
              below = isotropic[d]
          exit !(n > 50 && below > 0 && below < last) }' stdout

# --- a run that cannot be done -----------------------------------------------------------
mkdir three/mu-0.1_seed-1/snapshots
rm three/mu-0.3_seed-1/curve.csv three/mu-0.3_seed-1/status.json
mkdir three/mu-0.3_seed-1/curve.csv
sweep --out three
is 'what is no run is told and left alone' [ $? -eq 2 ]
rmdir three/mu-0.3_seed-1/curve.csv
sweep --set numerics.max_evaluations=1 --set numerics.tolerance=1e-12 --out guard
is 'failed runs give status 1' [ $? -eq 1 ]
is 'and are listed' [ "$(grep -c ',failed,"' guard/runs.csv)" -eq 4 ]

# --- signals -----------------------------------------------------------------------------
# No machine is through with such runs while it is looked at them.
endless='p1-nobridge-38nm particles.count=4000 loading.step=0.01% numerics.fidelity=reference'

two_work() { # directory
    [ "$(find . -path "./$1/*/status.json" | wc -l)" -ge 2 ]
}

# The command and both workers, which the kernel would call "exe" after the file.
three_named() {
    for process in $pid $(pgrep -P $pid); do
        cat "/proc/$process/comm"
    done >names
    [ "$(grep -cx greenbody names)" -eq 3 ]
}

ln -s "$greenbody" exe
# shellcheck disable=SC2086  # a list of words
./exe sweep $endless --replicas 4 --jobs 2 --yes --out long >stdout 2>stderr &
pid=$!
until_true two_work long
is 'processes are called greenbody' three_named
kill -TERM $pid
ended $pid
is 'SIGTERM: status 143' [ $? -eq 143 ]
is 'and nothing goes on' [ "$(grep -l '"state" : "running"' long/*/status.json | wc -l)" -eq 0 ]
is 'the list says so' [ "$(grep -c 'missing\|stopped' long/runs.csv)" -eq 4 ]
# shellcheck disable=SC2086
"$greenbody" sweep $endless --replicas 2 --jobs 2 --yes --out killed >stdout 2>stderr &
pid=$!
until_true two_work killed
kill -KILL $pid
ended $pid 2>/dev/null
is 'SIGKILL: the workers stop by themselves' until_true none_works killed

# --- several at once in one directory --------------------------------------------------------
# Runs of half a second, so that one can be met; tried again where it was not.
shared() { # more arguments; in place of its shell, so that $! is the sweep itself
    exec "$greenbody" sweep p1-nobridge-38nm particles.count=300 structure.base=auto \
        'loading.until=10 MPa' loading.unload_from= numerics.tolerance=3e-3 --vary 'contact.mu=0.1;0.3' \
        --replicas 2 --at '5 MPa' "$@"
}

is_done() { # directories of runs
    for run in "$@"; do
        grep -qs '"state" : "done"' "$run/status.json" || return 1
    done
}

stands() {
    ! grep -qs '^State:.[RSD]' "/proc/$worker/status" # stands, or is gone
}

# A sweep whose worker stands in its first run.
meet() {
    while :; do
        rm -rf shared
        shared --jobs 1 --out shared >/dev/null 2>first.err &
        first=$!
        until_true [ -e shared/mu-0.1_seed-1/preset.ini ]
        worker=$(cat /proc/$first/task/$first/children 2>/dev/null)
        worker=${worker%% *}
        if [ -n "$worker" ] && kill -STOP "$worker" && until_true stands &&
            [ -e shared/mu-0.1_seed-1/.lock ] && ! flock -n shared/mu-0.1_seed-1/.lock true; then
            return
        fi
        kill -CONT "$worker" 2>/dev/null
        ended $first
    done
}

# Of the sweep that met the standing worker, which holds a run.
first_writes() { # name
    kill -CONT "$worker"
    ended $first
    is "$1: the first ends with status 0" [ $? -eq 0 ]
    is "$1: and writes the table of one" cmp alone/sweep.csv shared/sweep.csv
    is "$1: and its list" cmp alone/runs.csv shared/runs.csv
}

(shared --out alone) >stdout 2>stderr
meet
(shared --jobs 1 --out shared) >stdout 2>stderr
is 'a second sweep ends with status 0' [ $? -eq 0 ]
is 'having done the runs that are left' is_done shared/mu-0.1_seed-2 shared/mu-0.3_seed-1 \
    shared/mu-0.3_seed-2
is 'says who holds the other' \
    grep -q "^nothing left to do here.*mu-0.1_seed-1 (process $worker on " stderr
is 'and leaves the tables to it' [ ! -e shared/sweep.csv ]
(shared --jobs 1 --collect --out shared) >stdout 2>stderr
is 'collected meanwhile, one is missing' [ $? -eq 1 ]
is 'and is listed' [ "$(grep -c ',missing,$' shared/runs.csv)" -eq 1 ]
first_writes 'a run held'

meet
kill -KILL $first "$worker"
ended $first 2>/dev/null
(shared --jobs 1 --out shared) >stdout 2>stderr
is 'what a killed one leaves is done by the next' [ $? -eq 0 ]
is 'with the same table' cmp alone/sweep.csv shared/sweep.csv

# With an error to be reached all wait.
meet
shared --jobs 1 --until-se 0.9@5MPa --out shared >stdout 2>stderr &
second=$!
until_true is_done shared/mu-0.3_seed-2
is 'with --until-se the second waits' kill -0 $second
kill -CONT "$worker"
ended $second
is 'and ends with status 0' [ $? -eq 0 ]
is 'and the table' cmp alone/sweep.csv shared/sweep.csv
ended $first

# --- tasks, parts, tables ------------------------------------------------------------------
export PATH="$here/bin:$PATH"
mkdir bin
ln -s "$greenbody" bin/greenbody
rm -rf shared
(shared --tasks --out shared) >tasks 2>stderr
is 'a task for each run' [ "$(grep -c '^greenbody sweep .* --part [1-4]/4$' tasks)" -eq 4 ]
is 'which does nothing yet' [ ! -e shared ]
tr '\n' '\0' <tasks | in_patience xargs -0 -P 2 -n 1 sh -c >stdout 2>stderr
is 'tasks end with status 0' [ $? -eq 0 ]
is 'without tables' [ ! -e shared/sweep.csv ]
(shared --tasks --out shared) >tasks 2>stderr
is 'what is done needs no task' [ ! -s tasks ]
(shared --collect --out shared) >stdout 2>stderr
is 'collected' [ $? -eq 0 ]
is 'they have the table of one process' cmp alone/sweep.csv shared/sweep.csv
is 'and its list' cmp alone/runs.csv shared/runs.csv
rm -rf shared
(shared --part 2/3 --out shared) >stdout 2>stderr
is 'a part does its runs only' [ "$(echo shared/*)" = shared/mu-0.3_seed-1 ]
failing() { # more arguments
    "$greenbody" sweep p1-nobridge-38nm particles.count=100 structure.base=auto \
        'loading.until=5 MPa' loading.unload_from= --vary 'contact.mu=0.1;0.3' --replicas 2 \
        --set numerics.max_evaluations=1 --set numerics.tolerance=1e-12 "$@" \
        >stdout 2>stderr
}
failing --out failed
failing --part 1/2 --out parts
is 'a part with failed runs has status 1' [ $? -eq 1 ]
failing --part 2/2 --out parts
failing --collect --out parts
is 'so has what is collected' [ $? -eq 1 ]
is 'with the errors of one process' cmp failed/runs.csv parts/runs.csv
for word in '--tasks --until-se 0.1@5MPa' '--part 1/2 --until-se 0.1@5MPa' '--part 0/2' \
    '--part 3/2' '--part 1' '--part 1/2/3' '--part -1/2' '--part 1/2 --collect' '--tasks --collect'; do
    # shellcheck disable=SC2086  # words
    refused "sweep $word" "$greenbody" sweep default --replicas 4 $word --out out
done

# --- from the start --------------------------------------------------------------------------
rm -rf shared
shared --jobs 2 --out shared >/dev/null 2>first.err &
first=$!
(shared --jobs 2 --out shared) >stdout 2>stderr
is 'two from the start' [ $? -eq 0 ]
ended $first
is 'both' [ $? -eq 0 ]
is 'make one table' cmp alone/sweep.csv shared/sweep.csv

# --- wrong input -------------------------------------------------------------------------
refused 'no --out' "$greenbody" sweep default
refused 'no preset' "$greenbody" sweep --out out
refused 'an unknown key' "$greenbody" sweep default --vary contact.nu=1:2:3 --out out
refused 'a value out of range' "$greenbody" sweep default --vary 'contact.mu=0.1;-1' --out out
refused 'no replicas' "$greenbody" sweep default --replicas 0 --out out
refused 'a target without pressure' "$greenbody" sweep default --until-se 0.1 --out out
refused 'a sweep of hours' "$greenbody" sweep p1-set2-9.7nm --replicas 900 --out out
is 'which names the option' grep -q 'repeat with --yes' stderr
refused 'pressures without unit' "$greenbody" sweep default --at 5 --out out
refused 'a point that cannot be' "$greenbody" sweep default \
    --vary 'loading.until=1 MPa;2 GPa' --set 'loading.unload_from=1 GPa' --out out
refused 'the directory of a run' "$greenbody" sweep default --out one/mu-0.1_seed-1

echo "1..$tests"
exit $bad
