#!/bin/sh
# The densities at a pressure: the cursor at a typed one, and the table, in a real terminal.
# Usage: pressure_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

at_80x24() {
    term resize-window -x 80 -y 24
    until_true fits_80
}

reads() { # text that may be wrapped
    screen | tr -s '\n ' ' ' | grep -q -- "$1"
}

open_terminal
printf 'density,density_error,p_MPa\n0.3,0.01,50\n0.4,0.02,200\n' >"$here/lab.csv"
start default particles.count=1000 loading.until=200MPa loading.unload_from=100MPa
shows "opens" '✓ done'
keys g
is "focus reaches mu" go_to mu
keys Enter C-u 0.4 Enter
shows "a second run is started" 'run 2 started'
shows "and comes to its end" '✓ done'
shows "the first is a previous one" 'a mu 0\.1'
keys e "$here/lab.csv" Enter
shows "points are measured" '▲ measured'

# --- the cursor at a pressure
keys @
shows "@ asks for a pressure" 'Densities at a pressure'
keys 100 Enter
shows "a number without unit is refused" '100.*: *[a-z]'
keys C-u '-5 MPa' Enter
shows "and a negative one" 'must be above 0'
keys C-u '100 MPa' Enter
shows "the line says where" 'density at 100 MPa: run 0\.[34]'
shows "with the scatter of one cell" 'run 0\.[0-9]* +- 0\.0064'
shows "the previous run too" ' a 0\.[0-9]* +- 0\.0064'
is "the measurement with its error" until_true reads 'measured 0\.350 +- 0\.015'
shows "the cursor stands there" '┼'
term resize-window -x 60 -y 20
shows "60 x 20 has all of it" 'measured 0\.350'
shows "and the cursor" '┼'
at_80x24
keys @ '150 MPa' Enter
shows "another pressure is typed at once" 'density at 150 MPa'
keys 2 @ '1 GPa' Enter
shows "from another view it is that of the pressure" '1 Pressure against'
shows "what is not reached has no number" 'density at 1 GPa: run -'
keys Left
shows "an arrow goes to a point of the curve" 'point [0-9]* of'
keys Escape
hides "Esc ends it" 'point [0-9]* of'

# --- one pane alone
keys z
shows "z says how to go back" 'z shows all again'
shows "the plot has all columns" '^── 1 Pressure against relative density ──'
hides "no other pane is shown" 'State'
keys Tab
shows "Tab zooms the next pane" '^── State ──'
hides "instead of the plot" '1 Pressure'
keys Tab
shows "and the events" '^── Events ──'
keys 2
shows "a view brings the plot" '^── 2 Distribution'
term resize-window -x 60 -y 20
shows "60 x 20 has the plot alone" '^── 2 Distribution'
hides "without the state" 'State'
at_80x24
keys 1 z
shows "z shows all again" '├── State'

# --- the table
keys '#'
shows "# opens the table" 'Densities of the curves'
shows "at four pressures" '10 MPa  *50 MPa  *100 MPa  *500 MPa'
shows "the run first, nothing beyond its end" '│ run .* 0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]*  *- '
shows "with the scatter of one cell" '+- cell .* 0\.0064'
shows "the measurement between its points" '│ measured  *-  *0\.3000  *0\.3500  *- '
shows "with its errors" '+- error .* 0\.0100  *0\.0150'
shows "the difference to the run, and beyond what" '│ *- run .*[0-9]!'
term resize-window -x 60 -y 20
shows "60 x 20 has all columns" '10 MPa  *50 MPa  *100 MPa  *500 MPa'
shows "and what the signs mean" '! beyond two.*│$'
keys G
shows "and scrolls to the previous run" '│ a mu 0\.1 .* 0\.'
shows "whose difference is within the scatter" '│ *- run .*[0-9]~'
at_80x24
keys '#'
hides "# closes it" 'Densities of the curves'
leaves "quits"

echo "1..$tests"
exit "$bad"
