# shellcheck shell=sh
# What tests of the program share, to be sourced: sets $greenbody and $presets from the
# arguments and works in a folder of its own, which goes away at the end.  What the program
# said last lies in the files stdout and stderr.
set -u
. "$(dirname "$0")/../common/patience.sh"
. "$(dirname "$0")/../common/engines.sh"

greenbody=$1
presets=$2
here=$(mktemp -d) || exit 1
trap 'end_engines; rm -rf "$here"' EXIT
# By a limit of time: what it hung at.
trap 'echo "# stopped after test $tests"; sed "s/^/# /" stderr stdout; exit 1' HUP INT TERM
cd "$here" || exit 1
export GB_PRESET_DIR="$presets" XDG_CONFIG_HOME="$here/config"
tests=0
bad=0
: >stdout
: >stderr

result() { # name, 0 when good
    tests=$((tests + 1))
    if [ "$2" -eq 0 ]; then
        echo "ok $tests $1"
    else
        echo "not ok $tests $1"
        sed 's/^/# /' stderr stdout
        bad=1
    fi
}

is() { # name, command...: good when the command succeeds
    name=$1
    shift
    "$@"
    result "$name" $?
}

# No run of a directory is under way: workers whose parent was killed stop by themselves.
none_works() { # directory
    # shellcheck disable=SC2044  # names without blanks
    for lock in $(find "$1" -name .lock); do
        flock -n "$lock" true || return 1
    done
    ! grep -rqs --include=status.json '"state" : "running"' "$1"
}
