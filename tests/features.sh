#!/bin/sh
# Builds without optional packages: each feature off alone, and all together, out of tree, with
# warnings as errors.  A feature compiles only its own files again, and clang, where it is
# installed, checks those.  With clang as the third word it builds the whole program, without any
# feature and with all.
# Usage: features.sh SOURCE BUILD_FOLDER [clang]
set -u
source=$(realpath "$1")
main=$2
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
tests=0
bad=0

result() { # name, 0 when good
    tests=$((tests + 1))
    if [ "$2" -eq 0 ]; then
        echo "ok $tests $1"
    else
        echo "not ok $tests $1"
        grep -E 'error|warning|ERROR' "$folder/log" | head -n 10 | cut -c 1-200 | sed 's/^/# /'
        bad=1
    fi
}

features() { # what the features not named are, feature=value...
    for feature in pictures images mpi; do
        value=$1
        for word; do
            [ "${word%=*}" != $feature ] || value=${word#*=}
        done
        printf ' -D%s=%s' $feature "$value"
    done
}

built() { # name, build folder, options of meson: configures, compiles, starts
    name=$1
    build=$2
    shift 2
    if [ -e "$build/build.ninja" ]; then
        meson configure "$build" "$@"
    else
        meson setup "$build" "$source" -Dwerror=true -Dbuildtype=plain -Doptimization=0 "$@"
    fi >"$folder/log" 2>&1 &&
        ninja -C "$build" src/cli/greenbody >>"$folder/log" 2>&1 &&
        (cd / && "$build/src/cli/greenbody" --version) >"$folder/version" 2>>"$folder/log" &&
        (cd / && "$build/src/cli/greenbody" run default particles.count=50 \
            loading.unload_from= loading.until=1MPa --quiet --force --out "$folder/run") \
            >>"$folder/log" 2>&1
    result "$name" $?
}

# The files of the features that were built last, also as clang reads them.
checked() { # name
    if command -v clang >/dev/null; then
        python3 "$source/tests/features.py" "$folder/one" "$main" clang >"$folder/log" 2>&1
        result "$1, read by clang" $?
    else
        tests=$((tests + 1))
        echo "ok $tests $1, read by clang # SKIP no clang here"
    fi
}

# shellcheck disable=SC2046  # words
if [ "${3:-}" = clang ]; then
    export CC=clang
    built 'all off, by clang' "$folder/clang" $(features disabled)
    built 'all that is found, by clang' "$folder/clang" $(features auto)
else
    built 'all features off' "$folder/one" $(features disabled)
    grep -q 'no pictures, no MPI' "$folder/version"
    result 'and said so' $?
    built 'images off' "$folder/one" $(features auto images=disabled)
    checked 'images off'
    built 'pictures off' "$folder/one" $(features auto pictures=disabled)
    checked 'pictures off'
    built 'MPI off' "$folder/one" $(features auto mpi=disabled)
    checked 'MPI off'
fi
echo "1..$tests"
exit $bad
