# shellcheck shell=sh
# Waits for events, to be sourced.  The limit is one that only a hang meets: a slow or busy
# machine, an old processor and a sanitizer together take far less.  Where they would not,
# GB_TEST_PATIENCE multiplies it.
patience_s=$((900 * ${GB_TEST_PATIENCE:-1}))

# command...: until it succeeds; 1 when it never does.  What takes more than a minute is told, so
# that a test that is stopped has said what it waited for.  After a hang nothing is waited for as
# long again, so that a broken program does not keep its tests busy for hours.
until_true() {
    until_true_end=$(($(date +%s) + patience_s))
    until_true_told=$(($(date +%s) + 60))
    while ! "$@"; do
        until_true_now=$(date +%s)
        [ "$until_true_now" -lt "$until_true_end" ] || {
            patience_s=20
            return 1
        }
        [ "$until_true_now" -lt "$until_true_told" ] || {
            echo "# waiting for: $*" >&2
            until_true_told=$((until_true_end + 1))
        }
        sleep 0.05
    done
}

# Runs a command that ends by itself: status 124 when it does not.
in_patience() {
    timeout "$patience_s" "$@"
}

# Waits for a child to end and returns its status.  One that hangs is killed: status 137.
ended() { # process
    until_true is_over "$1" || kill -KILL "$1"
    wait "$1"
}

is_over() { # process
    ! kill -0 "$1" 2>/dev/null || grep -qs '^State:.Z' "/proc/$1/status"
}
