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
shows "a time has a unit" '10: expected a CPU time above 0, as in 15min'
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
cursor_at_end() { # pressed again: an event may have taken its line
    keys End
    has 'Enter applies'
}
is "what was measured stays" until_true cursor_at_end
keys Enter
told "Enter applies the setting" 'setting of the chart: '
# the costliest one that was measured, as the event has it: the message may be that of the
# cursor before
term resize-window -x 200 -y 60
until_true has '│ [^│]*tolerance [0-9.e-]*,'
tolerance=$(screen | sed -n 's/.*│ [^│]*tolerance \([0-9.e-]*\),.*/\1/p' | tail -n 1)
term resize-window -x 80 -y 24
until_true fits_80
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
keys Escape

# --- stability of the same scene's methods
keys T
shows "the view behind the chart names the key" 'no stability yet: X measures the methods'
keys X
shows "X asks for states there" 'Stability of this scene.s methods'
keys -l 'here'
keys Enter
shows "a state is a pressure or a density" 'here: expected pressures or densities'
keys C-u
keys -l '10 MPa'
keys Enter
shows "it is measured in the background" 'stable step / step taken'
shows "what it finds is a card" 'Result: stability of the methods'
shows "with the method in use" 'in use: stable to [0-9.]* times its step'
is "table and scene are kept" [ -s "$(find "$here/state" -name stability.csv)" ]
keys Escape
keys Right
shows "the cursor reads the weakest state" 'in use; Enter applies'
shows "with density and step" 'MPa, density 0\.[0-9]*: stable to [0-9.]*, takes'
keys Home
shows "and the others" '^ steepest at '
keys Right
shows "one after the other" '^ fire at '
keys Enter
told "Enter applies the method" 'stable method:'
go_to relaxer
is "to the parameters" until_true has 'relaxer  *fire'
keys u
shows "u takes it back" 'relaxer  *auto'
keys T
leaves "quits in the end"

# --- far along the curve the longest step of a relaxer is beyond the bound
start default particles.count=60 loading.until=1GPa loading.unload_from=
shows "a dense packing" '✓ done'
keys T X C-u
keys -l '900 MPa'
keys Enter
shows "the card warns" 'in use: only stable to 0\.[0-9]* times its step'
shows "and says what comes of it" 'it shortens its step there'
keys Escape
keys End
shows "the cursor reads it" 'takes up to 1\.3, 0\.[0-9]*'
shows "as unstable" ' unstable, in use'
keys Enter
shows "Enter takes no such method" 'predict is not stable here'
leaves "quits the dense one"

# --- a dynamic scene has a time step
start p2-v1 particles.count=40 loading.until=density=0.7 loading.relax=0s loading.hold=0s
shows "discs are compressed" '✓ done'
shows "no value of State runs into its name" 'E err  *[-0-9.e]* %'
keys T X Enter
shows "velocity Verlet is measured" 'verlet, in use: stable'
keys Escape Right
shows "its cursor reads it" 'verlet at '
keys Enter
told "Enter applies half its longest step" 'stable method:'
go_to time_step
is "to the parameters again" until_true has 'time_step  *0\.[0-9]* T'
leaves "quits for good"

# --- a die has no cell
start p3-cycle particles.count=60
shows "a die opens" 'P3 die cycle'
keys T
shows "T says why there is none" 'stability needs a periodic cell'
keys X
shows "X says it, too" 'stability needs a periodic cell'
leaves "leaves the die"

echo "1..$tests"
exit "$bad"
