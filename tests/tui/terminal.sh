# shellcheck shell=sh
# A real terminal for the tests of the workbench, to be sourced: sets $greenbody and $presets
# from the arguments.  Waits for what the screen shows, as patience.sh does, and never for a
# time.
set -u
. "$(dirname "$0")/../common/patience.sh"
. "$(dirname "$0")/../common/engines.sh"

greenbody=$1
presets=$2
socket=greenbody-test-$$
here=$(mktemp -d) || exit 1
tests=0
bad=0
# Takes far longer than any of what is done with it.
# shellcheck disable=SC2034  # for those that source this
long='default particles.count=6000 loading.step=0.02% numerics.fidelity=reference'

export GB_PRESET_DIR="$presets" XDG_CONFIG_HOME="$here/config"
export XDG_STATE_HOME="$here/state" LC_ALL=C.UTF-8 ENV=
unset NO_COLOR COLORTERM TMUX LINES COLUMNS

# By a limit of time: what it hung at.
stopped() {
    echo "# stopped after test $tests; the screen:"
    screen | sed 's/^/# /'
    exit 1
}

# A run outlives its terminal.
finish() {
    term kill-server 2>/dev/null
    end_engines
    rm -rf "$here"
}
trap finish EXIT
trap stopped HUP INT TERM

term() {
    tmux -u -L "$socket" -f /dev/null "$@"
}

has_process() { # number; one that has ended and is not yet taken off has no environment
    grep -qs . "/proc/$1/environ"
}

has_no_process() {
    ! has_process "$1"
}

# Closes the terminal.  A server that ends may still take the command that should start the
# next one, which is lost then.
close_terminal() {
    server=$(term display-message -p '#{pid}' 2>/dev/null)
    term kill-server 2>/dev/null
    until_true has_no_process "${server:-none}"
}

screen() {
    term capture-pane -p
}

keys() {
    term send-keys "$@"
}

result() { # name, 0 when good
    tests=$((tests + 1))
    if [ "$2" -eq 0 ]; then
        echo "ok $tests $1"
    else
        echo "not ok $tests $1"
        screen | sed 's/^/# /'
        bad=1
    fi
}

has() {
    screen | grep -q -- "$1"
}

has_not() {
    ! has "$1"
}

shows() { # name, pattern
    until_true has "$2"
    result "$1" $?
}

hides() { # name, pattern
    until_true has_not "$2"
    result "$1" $?
}

is() { # name, command...
    name=$1
    shift
    "$@"
    result "$name" $?
}

# U+2800 to U+28FF, byte by byte: no grep knows them as a range in every locale
has_braille() {
    screen | LC_ALL=C grep -q "$(printf '\342[\240-\243]')"
}

density() {
    screen | sed -n 's/.*density *\(0\.[0-9][0-9]*\).*/\1/p' | tail -n 1
}

# Runs begin near the density of their structure, 0.24, and stay beyond this one once they
# have passed it, so that a slow look at the screen misses nothing.
is_pressed() {
    percent=$(density | cut -c 3-4)
    [ -n "$percent" ] && [ "$percent" -ge 30 ]
}

grows() { # name: the density on the screen goes up
    until_true is_pressed
    result "$1" $?
}

# A line of the events, however many came behind it: a screen of 60 rows holds them all.
told() { # name, pattern
    term resize-window -x 200 -y 60
    until_true has "$2"
    result "$1" $?
    term resize-window -x 80 -y 24
    until_true fits_80
}

fits_80() {
    [ "$(screen | wc -l)" -eq 24 ] && screen | tail -n 1 | grep -q 'q quit'
}

# Nothing comes within a second: awaited, since the last frame may be late.
sends_nothing() {
    rm -f "$here/sent"
    term pipe-pane "cat >'$here/sent'"
    sleep 1
    term pipe-pane
    [ ! -s "$here/sent" ]
}

asks_or_has_left() {
    has 'Quit?' || has 'status='
}

# q, and y where a live run is asked about; a result card would take the q.
leaves() { # name
    if has 'Result: '; then
        keys Escape
        until_true has_not 'Result: '
    fi
    keys q
    until_true asks_or_has_left
    has 'status=' || keys y
    shows "$1" 'status=0'
}

# The shell begins a line of its own with the status of what it ran.
start() { # words after greenbody, and settings before it in $with
    keys C-u "clear; ${with:-} '$greenbody' $*; echo status=\$?" Enter
}

terminal_is_back() {
    [ "$(term display-message -p '#{alternate_on} #{cursor_flag}')" = "0 1" ] || return 1
    keys "clear; stty -a | tr ' ;' '\\n\\n' | grep -x -e echo -e icanon -e isig | tr '\\n' ." \
        Enter
    until_true has 'isig.icanon.echo\.'
}

has_rows() { # directory
    grep -qs '^load,[2-9]' "$1/curve.csv"
}

# The full cell of the workbench: where the machine is slow it asks first.
computes() { # directory
    has 'takes long: r' && keys r
    has 'A long run' && keys y
    has_rows "$1"
}

# Of the workbench.
runs=$here/state/greenbody/runs

runs_number() { # number: as many run directories
    [ "$(find "$runs" -maxdepth 1 -name 'default-*' | wc -l)" -eq "$1" ]
}

runs_fully() { # the full cell, not its quick one
    screen | head -n 1 | grep -q '▶ running'
}

go_to() { # parameter
    keys / C-u "$1" Enter
    until_true has "^ $1: "
}

command -v tmux >/dev/null || {
    echo "Bail out! tmux is needed (./bootstrap installs it)"
    exit 1
}

# A terminal of 80 x 24 with a shell in it.  What is typed before the shell is up stands above
# its first prompt, and the new prompt behind that one.
open_terminal() {
    term new-session -d -x 80 -y 24 /bin/sh || exit 1
    keys "PS1='ready''> '" Enter
    until_true has 'ready>' || {
        echo "Bail out! no shell in the terminal"
        exit 1
    }
}
