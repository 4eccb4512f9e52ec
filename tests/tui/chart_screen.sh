#!/bin/sh
# Accuracy against cost, measured from within the workbench: points as they come, a cursor over
# them, a setting applied.
# Usage: chart_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

small='default particles.count=60 loading.until=20MPa loading.unload_from='

chart_csv() {
    find "$here/state" -name chart.csv
}

rows() { # at least so many settings are measured
    [ "$(awk -F, '!/^#/ && $10 > 0 { n++ } END { print n + 0 }' "$(chart_csv)" 2>/dev/null)" -gt "$1" ]
}

open_terminal
start "$small"
shows "a packing of 60 is pressed" '✓ done'
keys 0
shows "without a chart view 0 names the key" 'no chart yet: X measures this scene'
keys X
shows "X asks for cells, time and pressures" 'Accuracy against cost of this scene'
keys C-u
keys -l '1'
keys Enter
shows "one cell has no error" 'number of cells must be between 2 and 1000'
keys C-u
keys -l '2 10'
keys Enter
shows "a time has a unit" '10: accepted a CPU time above 0, as in 15min'
keys C-u
keys -l '2 15min 10MPa'
keys Enter
shows "it is measured in the background" 'measuring; the points follow the reference'
shows "the first points come while it runs" 'density error bound'
is "of some settings" until_true rows 3
shows "progress stands among the events" '[0-9]* of [0-9]*  .*CPU s'
keys Right
shows "the cursor reads a setting" 'CPU s a cell, error below'
shows "with what Enter does" 'Enter applies'
keys X
told "X again stops it" 'chart: \(cancelled\|stopped\)'
keys 0
keys End
shows "what was measured stays" 'Enter applies'
# the costliest one that was measured, as the message has it
tolerance=$(screen | tail -n 4 | tr '\n' ' ' | sed -n 's/.*tolerance \([0-9.e-]*\),.*/\1/p')
keys Enter
told "Enter applies the setting" 'setting of the chart: '
go_to tolerance
is "to the parameters" until_true has "tolerance  *$tolerance "
keys u
shows "u takes it back" 'tolerance  *auto'
leaves "quits"

# --- to its end: a card
start "$small numerics.fidelity=fast"
shows "again a packing" '✓ done'
keys X C-u
keys -l '2 1ms'
keys Enter
shows "a chart that ends has a card" 'Result: accuracy against cost'
shows "which says what is missing" 'no setting is known\|cheapest within the scatter'
shows "and how much was measured" 'of [0-9]* settings measured, view 0'
keys Escape
leaves "quits in the end"

echo "1..$tests"
exit "$bad"
