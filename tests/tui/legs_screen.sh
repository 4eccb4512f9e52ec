#!/bin/sh
# Loading paths in a real terminal: the editor of legs, the views, a what-if.
# Usage: legs_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

path='isotropic to 30 MPa; shear xz to 2 % at z = 30 MPa; unload'

# The header says "quick cell" while that is what runs.
full_cell_runs() {
    screen | head -n 1 | grep -q '▶ running'
}

open_terminal
start default particles.count=200 "'loading.path=$path'"
shows "a run with legs comes to its end" '✓ done'
shows "legs are branches of the curve" '3 unload'
shows "the state has the leg" 'leg  *3 of 3'
shows "and the shear stress" 'xz  *-*[0-9.]* MPa'
keys P
shows "P shows the stress path" 'P Stress path'
keys Q
shows "Q shows q against strain" 'shear strain xz, %'
keys U
shows "U shows volume strain" 'U Volume strain'
is "focus reaches the path" go_to path
keys Enter
shows "Enter opens the legs" 'Legs of loading.path'
shows "what leads is said" 'leads  *x, y, z'
shows "the plan is drawn" 'q, MPa'
keys Down
shows "what is held is said" 'held  *z at 30 MPa'
keys O
shows "O offers the shorthands" 'triaxial .x|y|z. .extension. to END'
keys sheer
shows "an error stands at its leg" "'sheer': must be uniaxial"
keys C-u hold Enter
shows "the leg is put in" '3 hold'
keys K
shows "K moves it up" '2 hold'
keys u
shows "u undoes" '3 hold'
keys D
hides "D deletes" '3 hold'
keys T C-u 'isotropic to 20 MPa then triaxial to 2 % at 20 MPa' Enter
shows "one text becomes legs" '2 triaxial to 2 %'
keys Escape
hides "Esc closes" 'Legs of loading.path'
shows "and restores" '^ path  *isotropic'
keys Enter Down D D y
hides "y takes the legs" 'Legs of loading.path'
shows "the cell runs again, along that leg" 'leg  *1 of 1'
leaves "quits"

# --- a what-if of a long run, which began in single precision
start default particles.count=6000 loading.step=0.02% \
    "'loading.path=isotropic to 300 MPa'" output.on_hangup=stop
is "a long path runs behind its quick cell" until_true full_cell_runs
keys f C-u 'path=shear xz to 2 % at z = 5 MPa then unload' Enter
shows "a shear is refused in single precision" 'legs that shear need double precision'
keys C-u 'path=uniaxial to 200 MPa then unload' Enter
told "another path is taken" 'changed after step'
leaves "and quits"

with='LC_ALL=C' start default particles.count=200 "'loading.path=$path'"
shows "without UTF-8 it opens" 'Parameters'
is "focus reaches the path, too" go_to path
keys Enter
shows "the legs open" 'Legs of loading.path'
is "all is ASCII" eval '! screen | LC_ALL=C grep -q "[^ -~]"'
keys Escape P
is "the stress path, too" eval '! screen | LC_ALL=C grep -q "[^ -~]"'
leaves "quits again"

echo "1..$tests"
exit "$bad"
