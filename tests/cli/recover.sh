#!/bin/sh
# `greenbody calibrate` on the engine, twenty times: curves of known friction and adhesion,
# the mean over many cells with noise of a known size added, are fitted with cells of other
# seeds, other ones each time.  The true values shall lie within the 95 % intervals, each in
# 18 trials or more, and the intervals shall not be wide for that.
# Usage: recover.sh GREENBODY PRESET_FOLDER [TRIALS]
. "$(dirname "$0")/folder.sh"

trials=${3:-20}
noise=0.003 # standard error of a measured density
# small cells and long steps: what they change is the same in the data and in the fit
scene='p1-set1-uniaxial particles.count=200 structure.base=auto numerics.fidelity=fast
    loading.step=0.3% numerics.strain_part=0.3% loading.until=410MPa loading.unload_from='

# --- the truth: contact.mu = 0.13, contact.alpha = 0.37 -------------------------------------
# shellcheck disable=SC2086  # a list of words
"$greenbody" sweep $scene structure.seed=100001 --replicas 120 \
    --at '10;25;60;150;400 MPa' --out truth >stdout 2>stderr
is 'the data are simulated' [ $? -eq 0 ]

# Seeds of the noise are the trial's number: the same in any awk with 53 bits.
measure() { # trial
    awk -F, -v trial="$1" -v noise="$noise" '
        function uniform() { x = (16807 * x) % 2147483647; return x / 2147483647 }
        BEGIN {
            x = 7919 * trial
            for (i = 0; i < 10; i++) uniform()
            print "p_MPa,density,density_error,branch"
        }
        /^1,/ {
            normal = -6
            for (i = 0; i < 12; i++) normal += uniform()
            printf "%s,%.6f,%.6f,%s\n", $3, $5 + noise * normal,
                sqrt(noise * noise + $6 * $6), $2
        }' truth/sweep.csv >lab.csv
}

calibrate() { # trial
    # shellcheck disable=SC2086
    "$greenbody" calibrate $scene structure.seed=$((1000 * $1)) \
        contact.mu=0.2 contact.alpha=0.3 --data lab.csv \
        --free contact.mu=0.04:0.4,contact.alpha=0.2:0.8 --replicas 6 --quiet --out fit \
        >stdout 2>stderr
}

trial=1
while [ "$trial" -le "$trials" ]; do
    measure "$trial"
    calibrate "$trial"
    is "trial $trial ends with status 0" [ $? -eq 0 ]
    grep '^contact' fit/calibration.csv >>all.csv
    rm -rf fit
    trial=$((trial + 1))
done

# --- how often, and how wide ----------------------------------------------------------------
hits() { # key, true value
    awk -F, -v key="$1" -v true="$2" '
        $1 == key { n++; good += $5 <= true && true <= $6; wide += $6 - $5; sum += $3 }
        END {
            printf "# %s = %s lies in %d of %d intervals, %.3f wide; mean of fits %.4f\n",
                key, true, good, n, wide / n, sum / n
            print good, wide / n >"hits"
        }' all.csv
}
holds() { # share of the trials, widest mean interval
    awk -v trials="$trials" -v share="$1" -v wide="$2" '
        { exit !($1 >= share * trials && $2 < wide) }' hits
}
hits contact.mu 0.13
is 'mu lies in its interval in 18 of 20' holds 0.9 0.1
hits contact.alpha 0.37
is 'alpha lies in its interval in 18 of 20' holds 0.9 0.15

echo "1..$tests"
exit $bad
