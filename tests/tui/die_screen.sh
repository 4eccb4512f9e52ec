#!/bin/sh
# A die in the workbench: its stages while it is filled, and on a screen that follows a run.
# Usage: die_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

at() { # columns, rows
    term resize-window -x "$1" -y "$2"
    until_true has 'q quit'
}

poured() {
    screen | sed -n '1s/.*filling \([0-9]*\) of 1751$/\1/p'
}

some_poured() {
    count=$(poured)
    [ -n "$count" ] && [ "$count" -gt 0 ]
}

open_terminal
start p3-hertz-mu0 numerics.fidelity=fast
shows 'the header has the stage and its measure' '▶ filling [0-9]* of 1751$'
shows 'the progress row, too, and no time that is not known' \
    '▶ filling [0-9]* of 1751 .* % estimating$'
is 'particles come down' until_true some_poured
shows 'particles in the die' 'in die *[0-9]'
shows 'the height of the powder' 'height *[0-9.]* [nu]m'
shows 'its kinetic energy' 'kin *[0-9.]* [a-z]*J'
shows 'its contacts' 'coord\. *[0-9]*\.[0-9]'
shows 'the number of time steps' 'steps *[0-9]'
keys 9
shows 'the bed is drawn meanwhile' '1751 '
at 60 20
shows 'at 60 x 20 as well' '▶ filling [0-9]* of 1751$'
at 120 40
shows 'wide, in a row of its own' '│ filling [0-9]* of 1751 *$'
shows 'with whole names' 'particles in the die *[0-9]'
at 80 24
keys 1
leaves 'quits a die that is filled'

rm -rf "$here/state"
"$greenbody" run p3-hertz-mu0 numerics.fidelity=fast --yes --quiet --out "$here/run" \
    >"$here/told" 2>&1 &
engine=$!
is 'status.json has the stage' until_true grep -qs '"name" : "filling"' "$here/run/status.json"
is 'and its measure' grep -q '"measure" : "particles poured"' "$here/run/status.json"
start attach "$here/run"
shows 'one who follows the run sees it' '▶ filling [0-9]* of 1751$'
shows 'and what is known' 'in die *[0-9]'
leaves 'leaves the run alone'
kill "$engine"
ended "$engine"

start p3-hertz-mu0 numerics.fidelity=fast particles.count=40
shows 'a small die is pressed' '✓ done'
shows 'with the quantities of a die' 'floor/p *[01]\.[0-9]'
shows 'and the height' 'height *[0-9.]* um'
shows 'no value runs into its name' 'rattl\.  *[0-9.]* %'
leaves 'quits'

# --- the die and its bed without colours and in ASCII
with=LC_ALL=C
start p3-hertz-mu0 numerics.fidelity=fast
keys 9
shows 'the sides of the die' '| .*[.:=+*#%@-].* |'
shows 'its funnel opens upwards' '\\\\.*/'
shows 'its floor' '-----'
keys F
shows 'F colours by the coordination number' 'coordination number 0 .* >*[0-9]'
keys F
shows 'by the pressure' 'pressure, MPa [0-9.e-]* .* >*[0-9]'
keys F
shows 'by the displacement' 'displacement, d 0 .* >*[0-9]'
keys F
hides 'and by depth again' 'displacement, d'
keys Tab
keys Right
shows 'an arrow turns it' 'turned by 345, 0 degrees'
keys Up
shows 'another shows it from above' 'turned by 345, 15 degrees'
keys Home
hides 'Home turns it to the front' 'turned by'
leaves 'quits in ASCII'
with=
start p3-hertz-mu0 numerics.fidelity=fast particles.count=40
keys 9
shows 'a pressed bed' '✓ done'
shows 'has the size of its box' '40 of 40'
keys F
shows 'and the range of its contacts' 'coordination number 0 '
leaves 'quits the small one'

echo "1..$tests"
exit "$bad"
