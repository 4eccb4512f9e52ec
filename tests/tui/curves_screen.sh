#!/bin/sh
# Curves compared, in a real terminal: colours, pins, names, differences, misfits, ranges of
# the axes, means with errors.
# Usage: curves_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

at_80x24() {
    term resize-window -x 80 -y 24
    until_true fits_80
}

esc=$(printf '\033')

coloured() { # marker in the legend: one of the colours, not dim
    term capture-pane -p -e | grep -q "$esc\[\(3[1-6]\|38;5;[0-9]*\)m$1$esc\[39m *$esc\[\(3[1-6]\|38;5;\(208\|108\|139\|160\|25\)\)mmu"
}

run_mu() { # value, number of the run
    keys Enter C-u "$1" Enter
    shows "mu $1 is set" "^[* ]mu  *$1 "
    shows "its run is started" "run $2 started"
    shows "and comes to its end" '✓ done'
}

ascii_only() {
    ! screen | LC_ALL=C grep -q "[^ -~]"
}

open_terminal
printf 'density,density_error,p_MPa\n0.3,0.01,50\n0.4,0.02,200\n' >"$here/lab.csv"
start default particles.count=300 loading.until=200MPa loading.unload_from=
shows "opens" '✓ done'
keys g
is "focus reaches mu" go_to mu
run_mu 0.4 2
run_mu 0.6 3
shows "the first is a previous one" 'a mu 0\.1'
is "in a colour" until_true coloured 'a'
is "and the second" until_true coloured 'b'

# --- the list
keys O
shows "O lists the curves" 'Curves (Enter names'
shows "with cell, density and difference" 'curve .* cell .* 100 MPa .* - run'
shows "the run first" '> run on display .* N 300 .* 0\.[34]'
shows "a difference with its verdict" 'a mu 0\.1 .* N 300 .* [+-]0\.[0-9]*[~!]'
keys D
shows "the run is not deleted" 'stays: another run replaces it'
keys m
shows "nor hidden" 'always shown'
keys G '*'
shows "a curve is pinned" '│ \* a mu 0\.1'
keys Enter
keys -l 'reference'
keys Enter
shows "and named" '│ \* a reference '
keys Enter
keys -l ' D H'
keys Escape
shows "Esc leaves the name" '│ \* a reference '
term resize-window -x 60 -y 20
shows "60 x 20 has all of it" 'a reference .* N 300 .* 0\.[0-9]* *[+-]0\.[0-9]*[~!]'
at_80x24
keys Escape
hides "Esc closes it" 'Curves (Enter names'
shows "the legend has the name" 'a reference'
keys m
hides "m hides the others" 'b mu 0\.4'
shows "the pinned one stays" 'a reference'
keys m
shows "m shows them again" 'b mu 0\.4'
keys O Down m
shows "one is hidden" '│  -b mu 0\.4'
keys O
hides "and not in the legend" 'b mu 0\.4'
keys '#'
shows "the table has the pinned one" '│ a reference .* 0\.'
hides "without the hidden one" 'b mu 0\.4'
keys '#' O Down D
hides "a curve is deleted" 'b mu 0\.4'
keys Escape

# --- differences
keys K
shows "K has the differences" 'K Density difference to the run'
shows "with a verdict at a pressure" 'a [+-]0\.[0-9]*[~!] reference'
shows "and the band of a cell" 'band: +- 0\.0293 (2 sd)'
keys @ '150 MPa' Enter
shows "another pressure is typed" 'at 150 MPa'
shows "without leaving the view" 'K Density difference'
keys L
shows "L has the logarithm of the pressure" 'K Density difference to the run (log)'
term resize-window -x 60 -y 20
shows "60 x 20 has the view" 'K Density difference'
shows "and the band" 'band: +- 0\.0293'
at_80x24
keys L 1

# --- ranges of the axes
keys Z
shows "Z asks for ranges" 'Ranges of the axes'
keys 'rho=0.3' Enter
shows "what is wrong is said" 'two values are needed'
keys C-u 'p=10 MPa:150 MPa rho=0.3:0.38' Enter
hides "ranges are taken" 'Ranges of the axes'
shows "the title says so" '1 Pressure against relative density, Z'
shows "the axis ends there" ' 0\.38 *$'
keys Z
shows "Z offers them again" 'p=10 MPa:150 MPa rho=0\.3:0\.38'
keys C-u Enter
hides "empty is automatic" 'relative density, Z'

# --- misfit of each curve
keys e "$here/lab.csv" Enter
shows "points are measured" '▲ measured'
keys '#'
shows "the table has the misfit" '500 MPa  misfit'
shows "of the run" '│ run .* - *[0-9.]* %'
shows "and of a previous curve" '│ a reference .* - *[0-9.]* %'
term resize-window -x 60 -y 20
shows "60 x 20 has the column" '500 MPa  misfit'
at_80x24
keys Escape

# --- means
shows "State has the scatter of one cell" 'rho(100 MPa) = 0\.[0-9]* +- 0\.010 (cell scatter)'
keys R C-u 4 Enter
shows "the means are a card" 'Result: replicas'
keys Escape
hides "which closes" 'Result: replicas'
shows "and the error of a mean" '(4 cells)'
shows "at that pressure" 'rho(100 MPa) = 0\.[0-9]* +- 0\.00[0-9]* (4 cells)'
shows "the legend says what the band is" 'mean of 4 cells, +- 2 errors'
term resize-window -x 60 -y 20
shows "60 x 20 has the mean, too" '^ rho(100 MPa) = 0\.[0-9]* +- 0\.00[0-9]* (4 cells)'
term resize-window -x 120 -y 40
shows "120 x 40 has its cells in a row of their own" '│ (4 cells)'
at_80x24
keys O
shows "the list is there still" '│ \* a reference'
leaves_list() { keys Escape; until_true has_not 'Curves (Enter'; }
is "and closes" leaves_list
leaves "quits"

# --- without UTF-8
with=LC_ALL=C
start default particles.count=200 loading.until=200MPa loading.unload_from=
shows "opens in ASCII" 'Parameters'
shows "and is pressed" '\* done'
keys g
go_to mu
keys Enter C-u 0.5 Enter
shows "another run" 'run 2 started'
shows "the first is a previous one" 'a mu 0\.1'
keys K
shows "differences" 'band: +- 0\.0'
is "all is ASCII" until_true ascii_only
keys O
shows "the list" '> run on display'
is "all is ASCII there" until_true ascii_only
keys Escape
leaves "quits"

echo "1..$tests"
exit "$bad"
