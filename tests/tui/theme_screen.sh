#!/bin/sh
# Themes on a real terminal: colours as sent, and the one that is remembered.
# Usage: theme_screen.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

settings=$here/config/greenbody/screen.ini
small='default particles.count=100 loading.until=20MPa loading.unload_from=10MPa'

sent() { # a sequence of colours on the screen
    term capture-pane -p -e | grep -q "$(printf '\033')\\[[0-9;]*$1"
}

unsent() {
    ! sent "$1"
}

opens() { # name
    shows "$1" '✓ done'
}

open_terminal
term set-option -g default-terminal tmux-256color
term respawn-pane -k /bin/sh
keys "PS1='ready''> '" Enter
shows "256 colours" 'ready>'
start "$small"
opens "opens"
is "the curve has a colour" sent '38;5;39m'
is "the background is that of the terminal" unsent '48;5;'
keys H
shows "H says which theme and where it is kept" 'theme light: .*; kept in'
is "its colours are those on the screen" until_true sent '38;5;32m'
is "not the ones before" until_true unsent '38;5;39m'
is "the file has it" until_true grep -qx 'theme=light' "$settings"
leaves "quits"
printf '# mine\n[screen]\n# slow line\nslow=on\ntheme=light\n' >"$settings"
start "$small"
opens "opens again"
is "with the theme of the file" sent '38;5;32m'
keys H
shows "the next one" 'theme dark: '
is "has its colours" until_true sent '38;5;45m'
is "is kept" until_true grep -qx 'theme=dark' "$settings"
is "beside the comments" grep -qx '# slow line' "$settings"
is "and the other settings" grep -qx 'slow=on' "$settings"
keys H
shows "high contrast" 'theme contrast: '
is "asks for a background" until_true sent '48;5;16m'
is "of every cell" [ "$(term capture-pane -p -e -N | sed -n 3p |
    grep -c "$(printf '\033')\\[[0-9;]*49m")" -eq 0 ]
leaves "quits from it"
is "and the terminal has its own again" until_true unsent '48;5;16m'
start "--theme=light $small"
opens "an option goes before the file"
is "for this time" sent '38;5;32m'
is "alone" grep -qx 'theme=contrast' "$settings"
leaves "quits"
with="COLORFGBG='15;0'"
start "--theme=auto $small"
opens "a terminal that tells its background"
is "gets the colours for it" sent '38;5;45m'
leaves "quits"
with='NO_COLOR=1'
start "--theme=contrast $small"
opens "NO_COLOR goes before all"
is "no colour is sent" unsent '[34]8;5;'
leaves "quits"
with=
start "--theme=pink $small"
shows "another name is refused" 'theme = pink: expected: auto, light, dark, contrast'
shows "with status 2" 'status=2'
printf 'no key file\n' >"$settings"
start "$small"
shows "so is a damaged file" 'screen.ini'

echo "1..$tests"
exit "$bad"
