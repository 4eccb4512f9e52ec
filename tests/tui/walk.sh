#!/bin/sh
# Every view and every key of the table at three sizes, without UTF-8 and without colours.
# Usage: walk.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

# The bottom line is the footer as long as the screen is whole.
is_whole() {
    screen | sed '/^$/d' | tail -n 1 | grep -q 'quit'
}

walk_views() { # size
    # key and the first words of the title: narrow panes cut the rest
    "$greenbody" --views | cut -c 1-22 >"$here/views"
    while IFS= read -r title; do
        keys "${title%% *}"
        shows "$1: ${title%% *} shows ${title#* }" "$title"
    done <"$here/views"
    keys v
    shows "$1: v goes round" "$(sed -n 1p "$here/views")"
    keys V
    shows "$1: V goes back" "$(sed -n '$p' "$here/views")"
    keys 1
    shows "$1: 1 is the first again" "$(sed -n 1p "$here/views")"
}

# Each row of the table by its first name, save those that leave: nothing breaks.
walk_keys() { # size
    "$greenbody" --keys | cut -c 1-10 >"$here/names"
    while read -r name _; do
        case $name in
        q | r | s | x | S-Tab) continue ;;
        Esc) name=Escape ;;
        ^L) name=C-l ;;
        PgUp) name=PPage ;;
        PgDn) name=NPage ;;
        esac
        keys "$name"
        keys Escape
        [ "$name" != z ] || keys z # all panes again
    done <"$here/names"
    keys Escape
    until_true is_whole
    result "$1: every key leaves the screen whole" $?
}

open_terminal
start default particles.count=300
shows "opens" 'Parameters'
shows "a packing of 300 is pressed" 'done'
for size in 80x24 200x60; do
    term resize-window -x "${size%x*}" -y "${size#*x}"
    until_true has 'Parameters'
    walk_views "$size"
    walk_keys "$size"
done
term resize-window -x 60 -y 20
walk_views 60x20
walk_keys 60x20
term resize-window -x 80 -y 24
leaves "quits"

for with in LC_ALL=C NO_COLOR=1 TERM=linux TERM=screen; do
    start default particles.count=300
    shows "$with: opens" 'Parameters'
    walk_views "$with"
    case $with in
    LC_ALL=C) is "$with: all is ASCII" eval '! screen | LC_ALL=C grep -q "[^ -~]"' ;;
    NO_COLOR=1)
        is "$with: there is no colour" \
            eval '! term capture-pane -p -e | grep -q "$(printf "\033")\[[0-9;]*[34][0-8]"'
        ;;
    esac
    leaves "$with: quits"
done

echo "1..$tests"
exit "$bad"
