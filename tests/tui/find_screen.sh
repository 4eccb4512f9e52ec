#!/bin/sh
# Parameters found by meaning, help with its glossary, footers of the panes, and the editor
# whose old value typing replaces, in a real terminal.
# Usage: find_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

footer_has() {
    screen | tail -n 1 | grep -q -- "$1"
}

footer_lacks() {
    ! footer_has "$1"
}

open_terminal
start default particles.count=100 loading.until=20MPa loading.unload_from=10MPa
shows "opens" '✓ done'

# --- search
keys / friction
shows "a synonym offers the parameter with its value" '│ contact.mu  *0\.1  *friction'
shows "the other frictions below" '│ contact.mu_wall'
hides "and nothing else" 'particles.count'
keys Enter
shows "Enter goes there" '^ mu: '
keys / 'α' Enter
shows "a Greek letter is its name" '^ alpha: '
keys / size Enter
shows "size is the diameter first" '^ diameter: '
keys / size Down Enter
shows "Down takes the next" '^ distribution: '
keys / 'elastic mod' Enter
shows "words of the meaning do" '^ young: '
keys / nothing-has-this
shows "what nothing has is said" 'no parameter has this name, symbol or meaning'
keys Enter
shows "and Enter stays" 'Find a parameter'
keys Escape
hides "Esc closes" 'Find a parameter'

# --- the editor
is "focus reaches mu" go_to mu
keys Enter
shows "the editor says what typing does" 'Typing replaces, Left and End edit'
keys 0.2
shows "the first character replaces the old value" '^ mu  *0\.2 '
hides "and the rest is added to it" 'Typing replaces'
keys Escape Enter End 5
shows "End edits it" '^ mu  *0\.15 '
keys Escape Enter Left 2
shows "Left, too" '^ mu  *0\.21 '
keys Escape Enter 0,3 Enter
shows "a comma is refused with the reason" '0,3: decimals have a point, thousands no mark: 0\.3'
keys Escape

# --- what-if with a wrong key
live() {
    screen | head -n 1 | grep -q '▶ running'
}

live_or_asks() {
    live || has 'the full cell takes long'
}

goes_on() { # a machine so slow that the run would take an hour asks
    until_true live_or_asks && live && return
    keys r
    until_true has 'A long run: start it?' && keys y && until_true live
}

leaves "quits"
# shellcheck disable=SC2086  # words
start $long
is "a long run is pressed" goes_on
keys f C-u friction=0.2 Enter
shows "what-if names the likely key" 'did you mean contact.mu?'
keys C-u muu=0.2 Enter
shows "of a key with a wrong letter, too" 'muu: no such key; did you mean contact.mu?'
keys Escape

# --- help
keys '?'
shows "? has groups" '│ Moving'
keys undo
shows "typing filters keys" '│ u <  *undo the last change'
hides "others are gone" 'Moving'
keys C-u rattler
shows "and the glossary" 'a particle with fewer contacts than equilibrium needs'
shows "below its heading" '│ Particles and contacts'
keys C-u springback
shows "a word" '│ springback'
keys C-u xyzzy
shows "what is nowhere is said" 'no key and no word of the glossary has this'
keys '?'
hides "? closes" 'Keys and glossary'

# --- footers
keys g
is "parameters: edit" until_true footer_has 'Enter edit'
keys Tab
is "plot: the cursor at a pressure" until_true footer_has '@ pressure'
is "not the editor" footer_lacks 'Enter edit'
keys Tab
is "state: what-if" until_true footer_has 'f what-if'
keys Tab
is "events: scrolling" until_true footer_has 'Up scroll'
is "help and quit are always there" footer_has '? help  *q quit'
term resize-window -x 60 -y 20
is "also in 60 columns" until_true footer_has '? help  *q quit'
term resize-window -x 80 -y 24
until_true fits_80
leaves "leaves"

echo "1..$tests"
exit "$bad"
