#!/bin/sh
# The same bits whether the C library uses fused multiply-add or not: glibc picks by the
# processor, and takes a word against it from the environment.
# Usage: fma.sh GREENBODY PRESET_FOLDER SAME_STATE
script=$(realpath "$0")
. "$(dirname "$0")/../cli/folder.sh"
same_state=$3
old=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-FMA4_Usable,-AVX2_Usable

rows() { # the curve without comments and times
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13,15-
}

scene() { # name, preset and keys
    what=$1
    shift
    rm -rf new old
    in_patience "$greenbody" run "$@" --quiet --out new >stdout 2>stderr
    is "$what" [ $? -eq 0 ]
    GLIBC_TUNABLES=$old in_patience "$greenbody" run "$@" --quiet --out old >stdout 2>stderr
    is "$what, without fused multiply-add" [ $? -eq 0 ]
    rows new >new.rows
    rows old >old.rows
    is "$what: the same curve" cmp new.rows old.rows
    is "$what: the same state" "$same_state" new old
}

is 'the column left out is the time' sh -c '
    "$1" run default particles.count=100 loading.unload_from= loading.until=1MPa --quiet \
        --out first >stdout 2>stderr &&
        [ "$(grep -v "^#" first/curve.csv | head -n 1 | cut -d, -f14)" = seconds ]' sh "$greenbody"
scene 'one size' default particles.count=200 loading.unload_from= loading.until=10MPa
scene 'log-normal sizes' p1-set2-lognormal particles.count=200 loading.unload_from= \
    loading.until=10MPa
scene 'in motion' p2-v1 particles.count=150 loading.until=density=0.52
scene 'a die of elastic spheres' p3-hertz-mu0 particles.count=60 numerics.fidelity=fast
scene 'a die of plastic spheres' p3-storakers-m0.2-mu0.01 particles.count=60 \
    numerics.fidelity=fast

echo "1..$tests"
exit $bad
