#!/bin/bash
# A clock of the day that jumps by days while runs are under way: nothing of a run goes by it.
# Usage: clock.sh GREENBODY PRESET_FOLDER LEAP_CLOCK_SO
. "$(dirname "$0")/folder.sh"

leap=$3
if ! LD_PRELOAD=$leap "$greenbody" --version >stdout 2>stderr; then
    echo "1..0 # SKIP this program takes no other clock"
    exit 0
fi
export TMUX_TMPDIR=$here
trap 'for name in clock back; do tmux -L $name kill-server; done 2>/dev/null; end_engines; rm -rf "$here"' EXIT

# The rows without their seconds, the 14th column.
rows() {
    grep -v '^#' "$1/curve.csv" | cut -d, -f1-13
}

# Long enough for two checkpoints on any machine.
scene=(default particles.count=600 numerics.tolerance=3e-3 "loading.until=60 MPa"
    loading.unload_from= "output.checkpoint_every=0.1 s")

# shellcheck disable=SC2016  # for the inner shell
days=$(LD_PRELOAD=$leap bash -c 'for _ in {1..50}; do printf "%(%F)T\n" -1; done' | sort -u |
    wc -l)
is 'the clock jumps' [ "$days" -gt 2 ]

"$greenbody" run "${scene[@]}" --quiet --out straight >stdout 2>stderr
is 'a run by a clock that goes' [ $? -eq 0 ]
LD_PRELOAD=$leap "$greenbody" run "${scene[@]}" --out leaping >stdout 2>stderr
is 'a run by one that jumps' [ $? -eq 0 ]
rows straight >straight.rows
rows leaping | cmp -s - straight.rows
result 'same curve' $?
grep -v '^#' leaping/curve.csv | sed 1d |
    awk -F, '$14 < last || $14 > 3600 { bad = 1 } { last = $14 } END { exit bad || NR < 10 }'
result 'its seconds only grow, and by as much as goes by' $?
is 'checkpoints come in time' [ -s leaping/state-before.h5 ]
# shellcheck disable=SC2016  # awk's own
is 'status has a sane time' awk -F': ' \
    '/"seconds" :/ { s = $2 + 0 } END { exit !(s > 0 && s < 3600) }' leaping/status.json

cp -r leaping broken
LD_PRELOAD=$leap "$greenbody" verify broken >stdout 2>stderr
is 'verify repeats it' grep -qx equal stdout

# --- the workbench, whose screen must go on -------------------------------------------------
tmux -L clock -f /dev/null new-session -d -x 100 -y 30 \
    "env LD_PRELOAD=$leap GB_PRESET_DIR=$presets XDG_STATE_HOME=$here/state $greenbody ${scene[0]} \
    ${scene[1]} 'loading.until=60 MPa' loading.unload_from= 2>screen.err; sleep 100"
shown() {
    tmux -L clock capture-pane -p >stdout 2>/dev/null
    grep -q 'done in' stdout
}

kept() { # written beside the screen
    grep -hqs '"state" : "done"' state/greenbody/runs/*/status.json
}
is 'the workbench shows its run to the end' until_true shown
is 'and it is kept' until_true kept

# --- keys while the clock is set back between any two looks at it ---------------------------
tmux -L clock kill-server
# a server of its own: the one that ends may still take the command
tmux -L back -f /dev/null new-session -d -x 100 -y 30 \
    "env LEAP_CLOCK=back LD_PRELOAD=$leap GB_PRESET_DIR=$presets XDG_STATE_HOME=$here/back \
    $greenbody default particles.count=300 2>screen.err; echo left; sleep 100"
on_screen() {
    tmux -L back capture-pane -p >stdout 2>/dev/null
    grep -q "$1" stdout
}
gone() {
    ! on_screen "$1"
}
is 'the workbench starts by a clock that is set back' until_true on_screen 'q quit'
tmux -L back send-keys '?'
is 'a key works' until_true on_screen 'Esc closes'
tmux -L back send-keys Escape
is 'Esc alone works, too' until_true gone 'Esc closes'
tmux -L back send-keys F10
is 'and a key of several bytes' until_true on_screen 'left\|Quit'

echo "1..$tests"
exit $bad
