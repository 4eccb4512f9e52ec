#!/bin/sh
# What the user says about his terminal, the mouse, and the manual page.
# Usage: flags.sh GREENBODY PRESET_FOLDER MANUAL_PAGE
. "$(dirname "$0")/terminal.sh"
manual=$3
small='default particles.count=300'

is_ascii() {
    ! screen | LC_ALL=C grep -q '[^ -~]'
}

has_colour() {
    term capture-pane -p -e | grep -q "$(printf '\033')\[[0-9;]*[34][0-8]"
}

has_no_colour() {
    ! has_colour
}

# A press at a column and a row, counted from 1, as a terminal reports it.
click() {
    term send-keys -l "$(printf '\033[<0;%d;%dM\033[<0;%d;%dm' "$1" "$2" "$1" "$2")"
}

wheel() { # 64 up, 65 down; column, row
    term send-keys -l "$(printf '\033[<%d;%d;%dM' "$1" "$2" "$3")"
}

has_prompt() {
    screen | grep -q '^ready> *$'
}

# Row of the screen, counted from 1, in which that stands.
row_of() {
    screen | grep -n -- "$1" | head -n 1 | cut -d : -f 1
}

# --- without a screen; the terminal is named here, for a caller may have none
TERM=xterm-256color
export TERM
"$greenbody" --diagnose >"$here/out" 2>&1
is "--diagnose leaves with 0" [ $? -eq 0 ]
for word in locale size terminal colours theme plots mouse images clipboard frames settings log runs; do
    is "--diagnose tells: $word" grep -q "^$word  " "$here/out"
done
is "--diagnose tells of no runs yet" grep -q 'runs: 0 kept, ' "$here/out"
"$greenbody" run $small --quiet --out "$here/kept/one" && mkdir "$here/kept/other"
"$greenbody" --diagnose --runs "$here/kept" >"$here/out" 2>&1
is "--diagnose counts the runs that are kept" \
    grep -q 'kept: 1 kept, [0-9.]*.*kB on the disk' "$here/out"
TERM=dumb "$greenbody" --diagnose >"$here/out" 2>&1
is "--diagnose of a dumb terminal" grep -q 'none: .*cannot position the cursor' "$here/out"
TERM=xterm COLORTERM=truecolor "$greenbody" --diagnose >"$here/out" 2>&1
is "COLORTERM gives more colours" grep -q '256 are used' "$here/out"
NO_COLOR=1 "$greenbody" --diagnose >"$here/out" 2>&1
is "NO_COLOR takes them" grep -q 'none are used' "$here/out"
LC_ALL=C "$greenbody" --diagnose >"$here/out" 2>&1
is "a locale without UTF-8 means ASCII" grep -q '^plots *ascii' "$here/out"
"$greenbody" default particles.count=100 --color=never --ascii --out "$here/run" \
    >"$here/out" 2>&1
is "where there is no screen, its options do no harm" [ -s "$here/run/curve.csv" ]
mkdir -p "$here/config/greenbody"
printf '[screen]\nslow = on\ngraph = block\n' >"$here/config/greenbody/screen.ini"
"$greenbody" --diagnose >"$here/out" 2>&1
is "screen.ini is read" grep -q '^plots *block' "$here/out"
is "all of it" grep -q 'at most 2 a second' "$here/out"
"$greenbody" --diagnose --graph=ascii >"$here/out" 2>&1
is "options go before it" grep -q '^plots *ascii' "$here/out"
printf '[screen]\nslow = maybe\n' >"$here/config/greenbody/screen.ini"
"$greenbody" --diagnose >"$here/out" 2>"$here/err"
is "a wrong value is an error of input" [ $? -eq 2 ]
is "in one line that names the file" grep -q 'screen.ini: slow = maybe: expected' "$here/err"
rm "$here/config/greenbody/screen.ini"

# --- the manual page has every key of the table
"$greenbody" --keys >"$here/keys"
missing=0
while IFS= read -r line; do
    help=$(echo "$line" | cut -c 11- | sed 's/-/\\-/g')
    grep -qxF -- "$help" "$manual" || {
        echo "# not in the manual page: $line"
        missing=1
    }
done <"$here/keys"
is "the manual page has every key" [ "$missing" -eq 0 ]
is "which are not few" [ "$(wc -l <"$here/keys")" -gt 40 ]

# --- options of the screen
open_terminal
start "$small --color=pink"
shows "a wrong option is told" 'color = pink: expected: auto, always, never'
shows "with status 2" 'status=2'
start "$small --ascii"
shows "--ascii opens" 'Parameters'
is "and all is ASCII" until_true is_ascii
keys b
shows "b stays there" 'Pressure against relative density'
is "and all is ASCII still" until_true is_ascii
leaves "and closes"
start "$small --color=never"
shows "--color=never opens" 'Parameters'
is "without colours" until_true has_no_colour
leaves "and closes, too"
with='NO_COLOR=1 TERM=xterm-256color' start "$small --color=always"
shows "--color=always opens" 'Parameters'
is "with colours" until_true has_colour
leaves "and closes as well"
start "$small --graph=block"
shows "--graph=block opens" 'Parameters'
shows "draws" 'density  *0\.[3-9]'
is "without braille" eval '! has_braille'
leaves "and closes again"
start "$small --batch --out $here/batch"
is "--batch does what run does" until_true grep -qs '"done"' "$here/batch/status.json"
shows "and leaves" 'status=0'

# --- what libraries write to standard error
keys C-u "clear; sh -c 'echo \$\$ >$here/pid; exec $greenbody $long'" Enter
shows "opens" 'Parameters'
shows "computes" '▶'
echo 'driver: no such thing' >>"/proc/$(cat "$here/pid")/fd/2"
told "what a library says stands among the events" 'library message: driver: no such'
keys q
until_true asks_or_has_left
keys y
until_true has_prompt

# --- the mouse, as a terminal of the kind xterm reports it
with='TERM=xterm-256color' start "$small"
shows "opens" 'Parameters'
shows "and is done" '✓ done'
keys a
shows "the marks of an edit stay while the full cell waits" 'waits for r'
keys g
is "focus reaches the contacts" go_to mu
click 5 "$(row_of '^ normal')"
shows "a click takes a parameter" '^ normal: '
click 5 "$(row_of '^ alpha')"
shows "and another" '^ alpha: '
wheel 64 25 "$(row_of '^ alpha')"
shows "the wheel over its value turns it" '^[*]alpha *0\.26'
wheel 65 25 "$(row_of '^[*]alpha')"
shows "and back" '^ alpha *0\.24'
click 60 8
shows "a click takes a point of the curve" '^ point [0-9]* of'
click 60 2
shows "a click on the title goes to the next view" '2 Distribution of'
click "$(screen | tail -n 1 | sed 's/? help.*//' | wc -c)" 24
shows "a click on the footer is its key" 'Keys and glossary'
shows "from its beginning" '│ Moving'
wheel 65 40 12
hides "the wheel scrolls the list of keys" '│ Moving'
keys Escape
hides "Esc closes it" 'Keys and glossary'
keys M
shows "M switches the mouse off" 'mouse off'
keys M
shows "and on" 'mouse on'
leaves "closes"
with='TERM=xterm-256color' start "$small --mouse=off"
shows "--mouse=off opens" 'Parameters'
is "without a mouse" [ "$(term display-message -p '#{mouse_any_flag}')" = 0 ]
keys M
shows "M switches it on" 'mouse on'
is "then it is reported" [ "$(term display-message -p '#{mouse_any_flag}')" = 1 ]
leaves "closes again"
is "the mouse is given back" [ "$(term display-message -p '#{mouse_any_flag}')" = 0 ]

echo "1..$tests"
exit "$bad"
