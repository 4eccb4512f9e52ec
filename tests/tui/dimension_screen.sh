#!/bin/sh
# Measured data and replicas of spheres, and then a scene of discs: they are not compared.  The header is
# about the run and not about what is edited.
# Usage: dimension_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

mkdir -p "$here/config/greenbody/presets"
sed -e 's/^count *=.*/count = 150/' -e 's/^title *=.*/title = discs of the test/' \
    -e 's/^relax *=.*/relax = 0.005 ns/' -e 's/^hold *=.*/hold = 0.005 ns/' \
    "$presets/p2-v1.ini" >"$here/config/greenbody/presets/discs.ini"
printf 'density,density_error,p_MPa\n0.3,0.01,50\n0.4,0.02,200\n' >"$here/lab.csv"

open_terminal
start default particles.count=300 numerics.fidelity=fast loading.until=300MPa loading.unload_from=
shows 'spheres are pressed' '✓ done'
keys e "$here/lab.csv" Enter
shows 'and compared with a measurement' '▲ measured, RMS misfit'
shows 'in the message as well' 'lab.csv: 2 of 2 points reached'
keys R C-u 2 Enter
shows 'replicas come to their end' 'Result: replicas'
keys Escape
shows 'and their mean is drawn' 'R mean of 2 cells'
keys '#'
shows 'and has a row' '│ R mean'
keys Escape

# --- the header
keys a
is 'focus reaches count' go_to count
keys Enter C-u 400 Enter
shows 'the quick cell of the edited count' 'N 400 .*quick cell'
shows 'it ends, and the run is the old one' 'N 300 .*✓ done'
shows 'whose parameter is edited' 'count  *400'

# --- discs
keys o discs Enter
shows 'discs follow' '^ greenbody  discs of the test · N 150'
keys r
shows 'and are compressed' 'N 150 .*✓ done'
hides 'the points are not over them' '▲ measured'
hides 'nor is the mean' 'R mean'
keys Tab
shows 'the message says why' 'lab.csv: loaded for a scene in 3D, not compared'
keys '#'
shows 'the table' 'Densities of the curves'
hides 'has no row of them' '│ measured'
hides 'nor of the mean' '│ R mean'
keys Escape e C-u "$here/lab.csv" Enter
shows 'loaded again they are data of discs' '▲ measured'
leaves 'quits'

# --- a small cell in the accuracy of the reference
start default particles.count=500 numerics.fidelity=reference
shows 'it has a quick cell first' 'quick cell, N 500'
leaves 'quits the reference'

echo "1..$tests"
exit "$bad"
