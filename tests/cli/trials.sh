#!/bin/sh
# `greenbody calibrate` on the engine, twenty times: known friction and adhesion have to lie
# in their 95 % intervals in 18 of 20 trials, each with other noise on the measured curve and
# with cells of other seeds.
# Usage: trials.sh GREENBODY PRESET_FOLDER [TRIALS]
. "$(dirname "$0")/folder.sh"
trials=${3:-20}

scene='p1-set1-uniaxial particles.count=200 structure.base=auto numerics.fidelity=fast
    loading.until=100MPa loading.unload_from=100MPa'
noise=0.004 # of a measured density

# shellcheck disable=SC2086  # a list of words
"$greenbody" sweep $scene contact.mu=0.13 contact.alpha=0.37 structure.seed=100001 \
    --replicas 100 --at '5;10;20;50;100 MPa' --out truth >stdout 2>stderr
is 'the curve is simulated' [ $? -eq 0 ]
is 'with six densities' [ "$(grep -c '^1,' truth/sweep.csv)" -eq 6 ]

# Noise that is the same with every awk: Park and Miller's generator, by twos to normal.
measure() { # trial
    awk -F, -v x="$((7919 * $1))" -v noise=$noise '
        function uniform() { x = (16807 * x) % 2147483647; return x / 2147483647 }
        BEGIN { print "p_MPa,density,density_error,branch"; for (i = 0; i < 20; i++) uniform() }
        /^1,/ { z = sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform())
                printf "%s,%.6f,%s,%s\n", $3, $5 + noise * z, noise, $2 }' truth/sweep.csv
}

holds() { # key, true value: 1 when it lies in the interval, which says something
    awk -F, -v key="$1" -v truth="$2" -v most="$3" '
        $1 == key { print $5 <= truth && truth <= $6 && $6 - $5 < most }' fit/calibration.csv
}

mu=0
alpha=0
for trial in $(seq "$trials"); do
    measure "$trial" >lab.csv
    rm -rf fit
    # shellcheck disable=SC2086
    "$greenbody" calibrate $scene structure.seed=$((100 * trial)) --data lab.csv \
        --free contact.mu=0.02:0.6,contact.alpha=0.15:1 --replicas 4 --out fit \
        >stdout 2>stderr || break
    mu=$((mu + $(holds contact.mu 0.13 0.3)))
    alpha=$((alpha + $(holds contact.alpha 0.37 0.6)))
    grep '^contact' stdout | sed "s/^/# trial $trial: /"
done
is "all $trials trials end" [ "$trial" -eq "$trials" ] && [ -s fit/calibration.csv ]
echo "# mu in $mu, alpha in $alpha of $trials intervals"
is 'mu lies in its interval' [ $((10 * mu)) -ge $((9 * trials)) ]
is 'alpha lies in its interval' [ $((10 * alpha)) -ge $((9 * trials)) ]

echo "1..$tests"
exit $bad
