#!/bin/sh
# Undo and redo through parameter sets with their curves, in a real terminal.
# Usage: undo_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

set_mu() { # value: its run comes to its end
    keys Enter C-u "$1" Enter
    shows "mu $1 is set" "^[* ]mu  *$1 "
    shows "its run is started" "run $2 started"
    shows "and comes to its end" '✓ done'
}

open_terminal
start default particles.count=200 loading.until=200MPa loading.unload_from=
shows "opens" '✓ done'
keys u
shows "there is nothing to undo yet" 'nothing to undo'
keys g
is "focus reaches mu" go_to mu
set_mu 0.2 2
set_mu 0.3 3
shows "the first run is a previous one" 'a mu 0\.1'
second=$(density)

# --- undo twice
keys u
shows "u goes back by one change" '^ mu  *0\.2 '
shows "and says which" 'undo: mu 0\.2; 1 more'
shows "its run is shown, not computed again" '✓ done'
shows "the one left is a previous curve" 'c mu 0\.3'
is "with its density" [ "$(density)" != "$second" ]
keys u
shows "again, to the first parameters" '^ mu  *0\.1 '
shows "which is the last step" 'undo: mu 0\.1; 0 more'
shows "their run is done" '✓ done'
shows "the second is a previous curve again" 'b mu 0\.2'
hides "the first is none any more" 'a mu 0\.1'
told "an event says where it is from" 'this run is from memory'
keys u
shows "there is nothing more" 'nothing to undo'

# --- redo
keys C-r
shows "Ctrl-R goes forward" '^ mu  *0\.2 '
keys '>'
shows "> does the same" '^ mu  *0\.3 '
shows "and shows its run" 'a mu 0\.1'
is "with its density" until_true eval "[ \"\$(density)\" = '$second' ]"
keys C-r
shows "there is nothing to redo" 'nothing to redo'
is "nothing was computed again" runs_number 3

# --- a change after an undo is a new branch; B goes back to the value of the run
keys a
shows "the full cell waits" 'the full cell waits for r'
keys '<'
shows "< undoes, too" '^ mu  *0\.2 '
keys +
shows "+ is a step" '^[*]mu  *0\.22 '
keys C-r
shows "the undone step is forgotten" 'nothing to redo'
keys B
shows "B goes back to the run's value" '^ mu  *0\.2 '
keys Escape u
shows "which can be undone, too" '^[*]mu  *0\.22 '

# --- a material is one step, and so is a preset, which brings its title back
keys d y t Enter
shows "another material" 'name  *yttria'
keys u
shows "is undone with all its keys" 'young  *382 GPa'
keys o p1-set1-biaxial Enter
shows "a preset is opened" 'greenbody  P1 set I'
shows "with many changes" '1[0-9] changes not run yet'
keys n u
shows "u leaves it from another pane" 'greenbody  alumina 10 nm, set II'
shows "and says how much that is" 'undo: 1[0-9] parameters; 2 more'
shows "with the run" 'a mu 0\.1'
leaves "quits"

# --- a run that was replaced goes on where it was
start "$long"
is "a long run starts" until_true runs_fully
shows "its curve grows" 'density 0\.2[5-9]'
keys g
is "focus reaches mu" go_to mu
keys Enter C-u 0.2 Enter r
told "another one replaces it" 'run 2 started'
keys u
told "u goes on with the first" 'the stopped run continues'
shows "with its curve" 'density 0\.[23]'
is "it runs" until_true runs_fully
leaves "quits"

echo "1..$tests"
exit "$bad"
