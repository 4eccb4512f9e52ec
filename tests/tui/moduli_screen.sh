#!/bin/sh
# Elastic moduli in the workbench: measured beside the screen from stored states, stopped by a
# second key, and the run stays as it is.
# Usage: moduli_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

# Directory of the only run.
run_directory() {
    find "$here/state" -name preset.ini -exec dirname {} \;
}

sums() {
    (cd "$(run_directory)" && sha256sum curve.csv state.h5 snapshots/*)
}

# Rows of the table below its header.
states() {
    [ "$(grep -vc '^#' "$(run_directory)/moduli.csv" 2>/dev/null)" = $(($1 + 1)) ]
}

open_terminal
start "default particles.count=300 numerics.fidelity=fast 'output.snapshots_at=density=0.4'"
shows 'a packing of 300 is pressed' 'done'
keys S
shows 'without moduli the view names the key' 'no moduli yet: Y measures'
sums >"$here/before"
keys Y
shows 'Y measures in the background' 'measuring'
shows 'at its end a card has the numbers' 'Result: elastic moduli'
keys Escape
hides 'Esc closes it' 'Result: '
shows 'the numbers of the last state' 'C11 .* C33 .* C44 .* C12 .* C13'
shows 'E, K and G have their markers' 'E [0-9.]*  .* K [0-9.]*  .* G [0-9.]* GPa'
shows 'probe and elastic range' 'nu 0\.[0-9]*; probe .*, elastic to'
hides 'the measurement ends' 'measuring: '
is 'both states are in the table' states 2
sums >"$here/after"
is 'the run is the same to the bit' cmp "$here/before" "$here/after"
keys Y
told 'nothing is measured twice' 'moduli saved'
is 'and the table is the same' states 2
shows 'the card comes again' 'Result: elastic moduli'
keys Escape
hides 'and closes' 'Result: '
"$greenbody" plot "$(run_directory)" --figure moduli -o "$here/figure.svg"
is 'plot draws the same table' test -s "$here/figure.svg"
leaves 'quits'

rm -rf "$here/state"
start default particles.count=1000 loading.step=0.005% numerics.fidelity=reference
shows 'a packing of 1000 is pressed behind its quick cell' '^ greenbody .*▶ running'
keys Y
shows 'a live run is measured once it has stored its state' 'measuring the first state'
keys Y
told 'Y again stops it' 'moduli: \(cancelled\|stopped\)'
shows 'the run goes on' 'running'
leaves 'quits a live run'

start p3-hertz-mu0 particles.count=150
shows 'a die is shown' 'Parameters'
keys S
shows 'a die has no moduli' 'moduli need a periodic cell'
leaves 'quits a die'

echo "1..$tests"
exit "$bad"
