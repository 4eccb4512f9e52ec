#!/bin/sh
# `greenbody run` as a user meets it: what a run leaves behind, and what wrong input gets.
# Usage: run.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

run() { # more arguments: the small scene
    "$greenbody" run default --set particles.count=200 --set "loading.until=5 MPa" \
        --set loading.unload_from= --set numerics.fidelity=fast "$@" >stdout 2>stderr
}

# name, expected status, command: one line on stderr, nothing on stdout, nothing left behind
refused() {
    name=$1
    expected=$2
    shift 2
    in_patience "$@" >stdout 2>stderr
    status=$?
    [ $status -eq "$expected" ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ] &&
        [ ! -e out ] && [ ! -e runs ]
    good=$?
    [ $good -eq 0 ] || echo "# status $status, expected $expected"
    result "$name" $good
}

header=branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,bridged,rattlers,
header=${header}residual,iterations,evaluations,seconds,pxy_MPa,pxz_MPa,pyz_MPa,q_MPa,
header=${header}asymmetry,exx,eyy,ezz,gxy,gxz,gyz,fxx,fyy,fzz,fxy,fxz,fyz,anisotropy,
header=${header}anisotropy_bridged,anisotropy_tension,anisotropy_force,leg,unrelaxed

# --- a run ------------------------------------------------------------------------------
run --out out
is 'a run ends with status 0' [ $? -eq 0 ]
for file in preset.ini curve.csv events.log status.json state.h5; do
    is "there is $file" [ -f "out/$file" ]
done
is 'header of the curve' grep -qx "$header" out/curve.csv
is 'the curve names the seed' grep -q '^# seed: 1$' out/curve.csv
is 'several points' [ "$(grep -c '^load,' out/curve.csv)" -gt 1 ]
is '37 columns everywhere' \
    awk -F, '!/^#/ && NF != 37 { bad = 1 } END { exit bad }' out/curve.csv
is 'no nan or inf' sh -c '! grep -v "^#" out/curve.csv | grep -qiE "nan|inf"'
is 'the pressure was reached' \
    awk -F, '/^load/ { p = $7 } END { exit !(p >= 5) }' out/curve.csv
is 'status says done' grep -q '"state" : "done"' out/status.json
is 'no temporary file is left' [ "$(find out -type f | wc -l)" -eq 5 ]
is 'last line names the directory' sh -c 'tail -n 1 stderr | grep -q out'

# --- the directory again ----------------------------------------------------------------
cp out/curve.csv first.csv
run --out out
is 'an old run is not overwritten' [ $? -eq 2 ]
is 'one line says so' [ "$(wc -l <stderr)" -eq 1 ]
is 'and it is as it was' cmp -s out/curve.csv first.csv
run --out out --force
is 'with --force it is replaced' [ $? -eq 0 ]
# seconds, the last column, are of the clock
cut -d, -f1-13 out/curve.csv >second.cut
cut -d, -f1-13 first.csv | cmp -s - second.cut
result 'same seed, same curve' $?
mv out/preset.ini again.ini
rm -rf out
"$greenbody" run again.ini --out out --quiet >stdout 2>stderr
is 'the stored preset repeats the run' [ $? -eq 0 ]
is 'quiet is quiet' [ ! -s stderr ]
cut -d, -f1-13 out/curve.csv | cmp -s - second.cut
result 'with the same curve' $?
for level in sse2 avx2 avx512; do
    GB_SIMD=$level run --out out --force
    cut -d, -f1-13 out/curve.csv | cmp -s - second.cut
    result "with the vectors of $level, too" $?
done
is 'sse2 means the narrowest' \
    sh -c "GB_SIMD=sse2 '$greenbody' --version | grep -q 'vectors: 128 bits'"
touch out/thesis.tex
run --out out --force
is 'a directory with foreign files is refused' [ $? -eq 2 ]
is 'the foreign file is named' grep -q thesis.tex stderr
rm -rf out

run
is 'without --out it goes to runs/' [ -f runs/default-1/curve.csv ]
rm -rf runs

# --- a signal ---------------------------------------------------------------------------
presses() {
    [ -e out/status.json ] && grep -q '^load' out/curve.csv
}

for signal in INT:130 TERM:143; do
    # a shell ignores INT in what it puts in the background; env gives it back
    env --default-signal=INT "$greenbody" run default --set particles.count=3000 \
        --set loading.step=0.01% --set numerics.fidelity=reference --out out >stdout 2>stderr &
    pid=$!
    until_true presses
    kill -s "${signal%:*}" $pid
    ended $pid
    is "${signal%:*} gives ${signal#*:}" [ $? -eq "${signal#*:}" ]
    is 'the state is kept' [ -s out/state.h5 ]
    is 'status says stopped' grep -q '"state" : "stopped"' out/status.json
    rm -rf out
done

# --- results for other programs ----------------------------------------------------------
json() { # expression of the object o, command...
    expression=$1
    shift
    "$@" >stdout 2>stderr
    python3 -c "import json, sys; o = json.load(sys.stdin); sys.exit(not ($expression))" <stdout
}
is 'run --json' json 'o["state"] == "done" and o["directory"] == "out" and o["pressure_MPa"] >= 5' \
    "$greenbody" run default particles.count=200 'loading.until=60 MPa' loading.unload_from= \
    'output.snapshots_at=3 MPa' --quiet --json --out out
is 'resume --json' json 'o["state"] == "done" and o["points"] > 5' "$greenbody" resume out \
    --quiet --json
is 'fit --json' json 'any(r["equation"] == "heckel" and r["parameter"] == "A" and
    r["unit"] == "1" and r["low"] < r["value"] < r["high"] for r in o["rows"])' \
    "$greenbody" fit out --equation heckel --json
is 'moduli --json' json 'len(o["rows"]) > 0 and all(r["C11_GPa"] > 0 for r in o["rows"])' \
    "$greenbody" moduli out --quiet --no-range --json
rm -rf out

# --- a compact beside its die, which has no density -----------------------------------------
rm -rf out
"$greenbody" run p3-cycle particles.count=20 'loading.time=2 us' --out out >stdout 2>stderr
is 'a die cycle' [ $? -eq 0 ]
is 'ends without a density' grep -q '^done after [0-9.]* s: p 0 MPa, ' stderr
"$greenbody" attach out >stdout 2>stderr </dev/null
is 'attach tells none either' grep -q 'out: p 0 MPa, step' stderr
is 'nor is there a nan' sh -c '! grep -q nan stderr'
rm -rf out

# --- states of the first moments of a dynamic run -------------------------------------------
"$greenbody" run p2-v1 particles.count=100 'loading.relax=0.1 ns' 'loading.hold=0.1 ns' \
    'output.snapshots_at=density = 0.7; density = 0.95; every 300' output.export=extxyz --out out \
    >stdout 2>stderr
is 'a short dynamic run' [ $? -eq 0 ]
is 'keeps all states' [ "$(ls out/snapshots | tr '\n' ' ')" = \
    'density-0.7.h5 density-0.95.h5 point-000001.h5 point-000301.h5 point-000601.h5 ' ]
is 'and exports them from the first on' [ "$(grep -c Lattice= out/trajectory.extxyz)" -eq 5 ]
rm -rf out

# --- goals that are not reached ----------------------------------------------------------
# name, text of the event, keys...
misses() {
    what=$1
    text=$2
    shift 2
    "$greenbody" run default particles.count=200 "$@" --out out >stdout 2>stderr
    is "$what: status 1" [ $? -eq 1 ]
    is "$what: an event" grep -q "$text" out/events.log
    is "$what: on the screen" grep -q "$text" stderr
    is "$what: in the status" grep -q "\"error\" : \"$text" out/status.json
    is "$what: which is done" grep -q '"state" : "done"' out/status.json
}

misses 'a soft powder' 'not reached: loading.until = 1 GPa, loading.unload_from = 1 GPa; ended' \
    'material.young=10 GPa' 'particles.diameter=1 um'
"$greenbody" resume out >stdout 2>stderr
is 'resumed, it says so again' [ $? -eq 1 ]
rm -rf out
misses 'a step past the end' 'exceeded: loading.until = 5 MPa by ' 'loading.until=5 MPa' \
    loading.unload_from= 'loading.step=2 %'
"$greenbody" resume out >stdout 2>stderr
is 'resumed, it says so again' [ $? -eq 1 ]
is 'a sweep of it is done' sh -c '"$1" sweep default particles.count=200 loading.unload_from= \
    "loading.until=5 MPa" "loading.step=2 %" --replicas 2 --out cells >stdout 2>stderr' - "$greenbody"
is 'and names the cell that missed its goal' \
    [ "$(grep -c ',done,"exceeded: loading.until' cells/runs.csv)" -eq 1 ]
rm -rf out cells
misses 'a step past an unloading' 'exceeded: loading.unload_from = 1 MPa by ' \
    'loading.until=density=0.3' 'loading.unload_from=1 MPa' 'loading.step=2 %'
rm -rf out
misses 'a step past the end of a leg' 'exceeded: leg 1 (uniaxial z to z = 1 MPa) ends at z = ' \
    'loading.path=uniaxial z to z = 1 MPa' 'loading.step=0.5 %' particles.count=150 \
    structure.seed=6 numerics.fidelity=fast
rm -rf out
misses 'a low density' 'not reached: loading.unload_from = 100 MPa; 1 GPa; ended' \
    loading.until=density=0.3
rm -rf out
"$greenbody" run p3-hertz-mu0 particles.count=60 numerics.fidelity=fast 'loading.time=1 ns' \
    --out out >stdout 2>stderr
is 'a punch too fast for the powder: status 1' [ $? -eq 1 ]
is 'with the pressure that was carried' grep -q \
    'not reached: loading.until = 50 MPa; the powder carries at most' out/events.log
is 'and not quasi-static' grep -q 'not quasi-static' out/events.log
rm -rf out
"$greenbody" run p3-hertz-mu0 particles.count=60 numerics.fidelity=fast --out out >stdout 2>stderr
is 'one that is slow enough: status 0' [ $? -eq 0 ]
rm -rf out
# name, status, text of an event, keys...: a die whose recorded densities are those of powder
die_ends() {
    what=$1
    status=$2
    text=$3
    shift 3
    "$greenbody" run p3-hertz-mu0 particles.count=60 numerics.fidelity=fast "$@" \
        --out out >stdout 2>stderr
    is "$what: status $status" [ $? -eq "$status" ]
    is "$what: an event" grep -q "$text" out/events.log
    is "$what: every density" awk -F, '/^(relax|load),/ { n++; bad += $3 > 1 || $3 < 0.15 }
        END { exit bad > 0 || n < 3 }' out/curve.csv
    rm -rf out
}
die_ends 'a die pressed beyond its pores' 1 'relative density .* contact laws hold up to 1' \
    'loading.until=1000 GPa' 'loading.record_pressure=1 GPa'
die_ends 'a punch too light for the time step' 0 'thrown off the punch' die.punch_mass=0.001

# Beyond full density nothing means anything: a guard, an event, status 1
"$greenbody" run default particles.count=200 numerics.fidelity=fast loading.unload_from= \
    'loading.path=isotropic to 60 %' --quiet --out dense >stdout 2>stderr
is 'a path beyond full density: status 1' [ $? -eq 1 ]
is 'and an event' grep -q 'relative density 1.*contact laws hold' dense/events.log
is 'without such a point' awk -F, \
    '/^load/ && $3 > 1 { bad = 1 } END { exit bad }' dense/curve.csv
rm -rf dense

# A guard that takes a shorter step and goes on is an event, not an error of the run.
"$greenbody" run p2-v4 structure.seed=1 particles.count=64 structure.density=0.5 \
    'loading.relax=0.005 ns' 'loading.hold=0 ns' 'loading.record_time=0.001 ns' \
    'loading.until=density = 0.6' 'loading.record=4 %' 'loading.rate=1 1/ns' \
    'numerics.time_step=10 T' 'material.epsilon=0 kB' --yes --out out >stdout 2>stderr
is 'a guard that goes on: status 0' [ $? -eq 0 ]
is 'a guard that goes on: an event' grep -q 'overlap by .*; time step halved' out/events.log
is 'a guard that goes on: no error' grep -q '"error" : ""' out/status.json
rm -rf out

misses 'no equilibrium' '[1-9][0-9]* of [0-9]* points are not in equilibrium' \
    numerics.max_evaluations=10 loading.unload_from=
above() { # the residual of each event is above the tolerance that it names
    sed -n 's/.*not fully relaxed: residual \([^ ]*\) .* tolerance \([^ ]*\)$/\1 \2/p' \
        out/events.log | awk '{ n++; bad += $1 <= $2 } END { exit bad > 0 || n == 0 }'
}
is 'each residual is told with the tolerance that it misses' above
points=$(awk -F, '$37 == 1' out/curve.csv | wc -l)
loaded=$(awk -F, '/^load/ && $37 == 1' out/curve.csv | wc -l)
is 'as many are marked' grep -q "error.*\"$points of" out/status.json
"$greenbody" plot --figure densification out -o hollow.csv
is 'a figure shows as many apart' [ "$(grep -v '^#' hollow.csv | tail -n +2 | cut -d, -f4 |
    grep -c .)" -eq "$loaded" ]
mean=$(grep -v '^#' hollow.csv | tail -n +2 | cut -d, -f2 | grep -c .)
is 'and leaves them out of the mean' [ "$mean" -le "$(grep -c '^load.*,0$' out/curve.csv)" ]
rm -rf out hollow.csv

# --- a size limit, as a full disk -------------------------------------------------------
(
    ulimit -f 16 # blocks of 512 bytes: less than the curve
    exec "$greenbody" run default --out out >stdout 2>stderr
)
is 'a full disk gives 3' [ $? -eq 3 ]
is 'and names a file' grep -q '^greenbody: out/' stderr
rm -rf out

# --- wrong input ------------------------------------------------------------------------
refused 'no preset' 2 "$greenbody" run --out out
refused 'unknown vectors' 2 env GB_SIMD=mmx "$greenbody" run default --out out
refused 'two presets' 2 "$greenbody" run default p1-set2-9.7nm --out out
refused 'unknown option' 2 "$greenbody" run default --colour --out out
refused 'unknown preset' 2 "$greenbody" run no-such-preset --out out
refused 'a file that is missing' 2 "$greenbody" run ./missing.ini --out out
refused 'a directory as preset' 2 "$greenbody" run . --out out
printf 'not a preset\n' >broken.ini
refused 'a broken file' 2 "$greenbody" run broken.ini --out out
head -c 3000 /dev/urandom >noise.ini
refused 'a binary file' 2 "$greenbody" run noise.ini --out out
if [ "$(id -u)" -ne 0 ]; then
    : >locked.ini
    chmod 000 locked.ini
    refused 'an unreadable file' 3 "$greenbody" run ./locked.ini --out out
    mkdir closed
    chmod 555 closed
    refused 'a parent that cannot be written' 3 "$greenbody" run default --out closed/run
fi
refused_set() { # name, assignment
    refused "$1" 2 "$greenbody" run default --set "$2" --out out
}
refused_set 'unknown key' contact.nu=0.1
refused_set 'unknown group' contcat.mu=0.1
refused_set 'no value' contact.mu
refused_set 'wrong unit' 'particles.diameter=10 MPa'
refused_set 'missing unit' particles.diameter=10
refused_set 'negative size' 'particles.diameter=-10 nm'
refused_set 'nan' contact.mu=nan
refused_set 'infinite' contact.mu=inf
refused_set 'empty number' contact.mu=
refused_set 'decimal comma' contact.mu=0,1
refused_set 'count of zero' particles.count=0
refused_set 'fraction of a particle' particles.count=10.5
refused_set 'density that cannot be reached' structure.density=0.7
refused_set 'cell too small for the cutoff' 'structure.base=2 d'
refused_set 'unloading beyond the end' 'loading.unload_from=2 GPa'
refused_set 'unknown choice' loading.geometry=sideways
refused_set 'unknown relaxer' numerics.relaxer=prayer
# days on any machine, known before there is a directory
mkdir -p kept/old
"$greenbody" run default particles.count=100 'loading.until=density=0.25' loading.unload_from= \
    --quiet --out kept/old
cp -r kept/old kept/copy
refused 'a long dynamic run is not begun unasked in an old directory' 2 \
    "$greenbody" run p2-v5 --set 'numerics.time_step=0.001 T' --force --out kept/old
is 'which stays as it was' diff -r kept/old kept/copy
rm -rf kept
refused 'a long dynamic run is not begun unasked' 2 \
    "$greenbody" run p2-v5 --set 'numerics.time_step=0.001 T' --out out
is 'and the way to begin it is named' grep -qe --yes stderr
refused_set 'a rate of zero' 'loading.rate=0 1/s'
refused 'a dynamic scene to a pressure' 2 \
    "$greenbody" run p2-v1 --set 'loading.until=1 GPa' --out out
refused 'an empty directory name' 2 "$greenbody" run default --out ''
touch file
refused 'a file as directory' 2 "$greenbody" run default --out file
refused 'below a file' 2 "$greenbody" run default --out file/run
refused 'a directory that cannot be made' 3 "$greenbody" run default --out /proc/gb/run

echo "1..$tests"
exit $bad
