#!/bin/sh
# Result cards: what a job in the background has found comes by itself, blocks nothing, is
# recalled by a key, opened and used.
# Usage: results_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

small='default particles.count=100 loading.until=50MPa loading.unload_from='

# The value of a parameter in the list.
value_is() { # name, pattern
    screen | grep -q "^ *$1 .*$2"
}

closes() { # name
    keys Escape
    hides "$1" 'Result: '
}

open_terminal
start "$small"
shows "a packing of 100 is pressed" '✓ done'
keys W
shows "without a result W says what makes one" 'no result yet: C, R, Y, s and x'
keys s
shows "s asks what to show" 'Picture'
keys Enter
shows "the picture has a card when it is drawn" 'Result: picture'
shows "with its size" '[0-9]* x [0-9]* pixels, [0-9.]* [kM]B'
hides "of a screen, not of paper" 'in print'
shows "and its path" 'greenbody/runs/default-1'
keys o
shows "without pixels o shows where it is" 'this terminal shows no pixels: open'
keys Enter
shows "there is nothing to use in it" 'nothing to use in this result'
closes "Esc closes it"
keys x
shows "the report has a card" 'Result: report (1 of 2)'
shows "with what is in it" '[0-9]* figures, [0-9]* pictures, [0-9]* tables'
keys o
shows "o names its page" 'in a browser: '
shows "which is there" 'index\.html'
keys Left
shows "Left shows the one before" 'Result: picture (2 of 2)'
keys Right
shows "Right the newer one" 'Result: report (1 of 2)'
keys 2
shows "another key acts as without a card" '2 Distribution of the coordination'
hides "and the card is closed" 'Result: '
keys E
shows "view E fits equations" 'E Equations'
keys W
shows "W shows the fit of the view" 'Result: equations of compaction (1 of 3)'
shows "parameters with their intervals" ' = .* +- .*, 95 %: .* to '
shows "their unit behind the value" 'Heckel 1/K = .* MPa, 95 %: '
shows "and what they are worth" 'RMS residual'
closes "and is closed"
keys Y
shows "moduli have a card" 'Result: elastic moduli (1 of 4)'
shows "with its state" '1 state: density 0\.[0-9]*, [0-9.]* MPa'
shows "with averages" 'E [0-9.]* GPa, K [0-9.]* GPa, G [0-9.]* GPa, nu 0'
shows "and no invented interval" 'one cell, no interval'
closes "Esc closes it, too"

# --- replicas and a calibration
keys R
shows "R asks how many" 'Replicas of this scene'
keys C-u
keys -l '3 0.00001@10MPa'
keys Enter
shows "replicas have a card" 'Result: replicas'
shows "with mean and interval" 'density at 10 MPa: 0\.[0-9]* +- 0\.[0-9]*, 95 %: 0'
shows "warned of an error above what was asked" '! *standard error .* at 10 MPa is above 1e-05'
closes "and are closed"
printf 'p_MPa,density,density_error\n20,0.30,0.01\n50,0.35,0.01\n' >"$here/lab.csv"
keys e
shows "e asks for measured data" 'Measured data over the plot'
keys -l "$here/lab.csv"
keys Enter
shows "which lie over the plot" 'measured, RMS misfit'
keys C
shows "C asks for keys" 'Calibration to the measured'
keys C-u
keys -l 'mu=0.05:0.4,alpha=0.2:0.5'
keys Enter
shows "the calibration has a card" 'Result: calibration'
shows "with value and interval" 'contact.mu = .*, 95 %: .* to '
shows "and correlation" 'correlation of contact.mu and contact.alpha: '
fit=$(dirname "$(find "$here/state" -name calibration.csv)")
is "the same text is a file" grep -q '^contact.mu = .*95 %' "$fit/calibration.txt"
keys Enter
told "Enter uses the values" 's: calibration used: contact'
calibrated=$(sed -n 's/^mu = \(0\.[0-9]\{3\}\).*/\1/p' "$fit/calibrated.ini")
go_to mu
is "which are those of calibrated.ini" until_true value_is mu "$calibrated"
keys W
shows "W recalls the card" 'Result: calibration (1 of '
closes "and it is closed again"
keys u
is "u goes back" until_true value_is mu '0\.1 '
leaves "quits"

# --- a live run is not disturbed, nor what is typed
states() {
    find "$here/state" -name state.h5 | wc -l
}
is_stored() {
    has 'takes long: r' && keys r
    has 'A long run' && keys y
    [ "$(states)" -gt "$stored" ]
}
stored=$(states)
start "$long output.checkpoint_every=1s"
is "a long run has stored its packing" until_true is_stored
keys s
shows "s asks" 'Picture'
keys Enter
hides "and closes" 'Picture.*Esc'
keys /
keys -l 'contact.a'
shows "a result does not interrupt what is typed" 'Name, symbol or meaning'
is_drawn() {
    [ "$(find "$here/state" -name 'picture-*.png' | wc -l)" -eq 2 ]
}
is "the picture is drawn meanwhile" until_true is_drawn
shows "and told below" 'picture: the result is there, W shows it'
shows "what was typed stays" 'contact.a'
keys Escape
keys W
shows "W shows it" 'Result: picture'
term resize-window -x 60 -y 20
shows "at 60 x 20, too" 'Esc: close'
is "and the engine goes on behind it" until_true has 'running'
term resize-window -x 80 -y 24
closes "closes"
leaves "quits a live run"

echo "1..$tests"
exit "$bad"
