#!/bin/sh
# `greenbody calibrate` on the engine: cells of known friction and adhesion give the data,
# other cells find them again.
# Usage: calibrate.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

refused() { # name, command: status 2, one line on stderr, nothing left behind
    name=$1
    shift
    in_patience "$@" >stdout 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] && [ ! -s stdout ] && [ ! -e out ]
    result "$name" $?
}

scene='p1-set1-uniaxial particles.count=300 structure.base=auto numerics.fidelity=fast'

# --- the data: cells of other seeds ------------------------------------------------------
# A row has its own cells: a fit takes the errors of rows for independent, and densities of the
# same cells at several pressures are not.
seed=100
cells() { # branch, pressure in MPa, key of the loading...: the row of twelve cells
    branch=$1
    pressure=$2
    shift 2
    # shellcheck disable=SC2086  # a list of words
    "$greenbody" sweep $scene "$@" structure.seed=$seed --replicas 12 --at "$pressure MPa" \
        --out truth >stdout 2>stderr || return 1
    grep "^1,$branch,$pressure," truth/sweep.csv
    rm -r truth
    seed=$((seed + 100))
}
for pressure in 10 20 50 100 200; do
    cells load $pressure "loading.until=$((pressure + pressure / 10)) MPa" loading.unload_from=
done >rows.csv
for pressure in 50 200; do
    cells unload $pressure "loading.until=$pressure MPa" "loading.unload_from=$pressure MPa"
done >>rows.csv
cells load 200 'loading.until=220 MPa' loading.unload_from= >others.csv
awk -F, 'BEGIN { print "p_MPa,density,density_error,branch" }
    { print $3 "," $5 "," $6 "," $2 }' rows.csv >lab.csv
is 'seven densities are simulated' [ "$(wc -l <lab.csv)" -eq 8 ]

# --- the fit -----------------------------------------------------------------------------
calibrate() {
    # shellcheck disable=SC2086
    "$greenbody" calibrate $scene contact.mu=0.2 contact.alpha=0.3 --data lab.csv \
        --free contact.mu=0.04:0.4,contact.alpha=0.2:0.8 --replicas 8 --out fit "$@" \
        >stdout 2>stderr
}
# Both values together: the region of 95 % of two parameters from seven densities has
# q <= 2 F(2, 5) = 11.57.  Each by itself lies in its interval in 19 of 20 fits, which
# calibrate_recovers counts.
calibrate
is 'the fit ends with status 0' [ $? -eq 0 ]
is 'mu = 0.13 and alpha = 0.37 lie in their region' awk -F, '
    $1 == "contact.mu" { a = ($3 - 0.13) / $4; r = $8; narrow = $6 - $5 < 0.2 }
    $1 == "contact.alpha" { b = ($3 - 0.37) / $4; narrow = narrow && $6 - $5 < 0.3 }
    END { q = (a * a - 2 * r * a * b + b * b) / (1 - r * r)
          exit !(narrow && b != "" && q <= 11.57) }' fit/calibration.csv
is 'the fit is as good as the data' awk -F, '
    NR > 1 { d = $4 - $6; n++; s += d * d }
    END { exit !(n == 7 && sqrt(s / n) < 0.008) }' fit/fit.csv
is 'the fitted preset can be run' \
    "$greenbody" run fit/calibrated.ini --set 'loading.until=1 MPa' \
    --set loading.unload_from= --quiet --out again

# --- once more ---------------------------------------------------------------------------
cp fit/calibration.csv first.csv
cp stdout first
find fit/runs -name curve.csv -exec touch -d 2001-01-01 {} +
calibrate --jobs 1
is 'a finished fit is found again' cmp first.csv fit/calibration.csv
is 'and told again' cmp first stdout
is 'without a new run' [ -z "$(find fit/runs -name curve.csv -newermt 2002-01-01)" ]

# --- more than densities -----------------------------------------------------------------
awk -F, 'BEGIN { print "p_MPa,density,density_error,lateral_ratio,lateral_ratio_error," \
                       "coordination,coordination_error,branch,weight" }
    FNR == NR { print $3 "," $5 "," $6 ",,,,," $2 ",2"; next }
    { print $3 ",,," $13 / $17 "," $14 / $17 "," $7 "," $8 ",load," }' \
    rows.csv others.csv >more.csv
# shellcheck disable=SC2086
"$greenbody" calibrate $scene contact.mu=0.2 contact.alpha=0.3 --data more.csv \
    --free mu=0.04:0.4,contact.alpha=0.2:0.8 --replicas 8 --out fit >stdout 2>stderr
is 'three quantities are fitted together' [ $? -eq 0 ]
is 'each has its rows' awk -F, '
    { n[$8]++ } END { exit !(n["density"] == 7 && n["lateral_ratio"] == 1 &&
                             n["coordination"] == 1) }' fit/fit.csv
is 'mu and alpha lie in their intervals' awk -F, '
    $1 == "contact.mu" { mu = $5 <= 0.13 && 0.13 <= $6 }
    $1 == "contact.alpha" { alpha = $5 <= 0.37 && 0.37 <= $6 }
    END { exit !(mu && alpha) }' fit/calibration.csv
# The intervals of one of them scatter too much; the correlation is the rest of the ellipse.
is 'both lie in a smaller ellipse' awk -F, '
    FNR == NR && $1 == "contact.mu" { rows++; before = $4 * sqrt(1 - $8 * $8) }
    FNR == NR && $1 == "contact.alpha" { rows++; before *= $4 }
    FNR != NR && $1 == "contact.mu" { rows++; after = $4 * sqrt(1 - $8 * $8) }
    FNR != NR && $1 == "contact.alpha" { rows++; after *= $4 }
    END { exit !(rows == 4 && after > 0 && after < 0.7 * before) }' first.csv \
    fit/calibration.csv
is 'the residuals of each are told' grep -q 'in density, .* in lateral ratio, .* in coord' stdout

# --- wrong input -------------------------------------------------------------------------
set -- "$greenbody" calibrate p1-set1-uniaxial --out out
refused 'no data' "$@" --free contact.mu
refused 'no keys' "$@" --data lab.csv
refused 'an unknown key' "$@" --data lab.csv --free contact.nu
refused 'a key that is no number' "$@" --data lab.csv --free loading.geometry
refused 'a key twice' "$@" --data lab.csv --free contact.mu,contact.mu
refused 'a range upside down' "$@" --data lab.csv --free contact.mu=0.4:0.1
refused 'two replicas' "$@" --data lab.csv --free contact.mu --replicas 2
printf 'p_MPa,density,colour\n100,0.5,3\n' >wrong.csv
refused 'a column of nothing known' "$@" --data wrong.csv --free contact.mu
printf 'p_MPa,density\n100,1.5\n' >wrong.csv
refused 'a density above 1' "$@" --data wrong.csv --free contact.mu
printf 'p_MPa,density,particles.diameter_MPa\n100,0.5,3\n' >wrong.csv
refused 'a unit of another kind' "$@" --data wrong.csv --free contact.mu
is 'too few data are refused before any run' [ ! -e out ]

echo "1..$tests"
exit $bad
