#!/bin/sh
# Completion of the command line: what the program knows, and what the shells make of it.
. "$(dirname "$0")/folder.sh"
scripts=$presets/../src/cli/completions
folder=$(dirname "$greenbody")

# The candidates of a line, without descriptions, are these.
gives() { # expected words, words of the line...
    expected=$1
    shift
    "$greenbody" --complete "$@" >full 2>stderr
    cut -f1 full | tr '\n' ' ' >stdout
    [ "$(cat stdout)" = "$expected${expected:+ }" ]
}
holds() { # one of them, words of the line...
    one=$1
    shift
    "$greenbody" --complete "$@" 2>stderr | cut -f1 >stdout
    grep -qxF -- "$one" stdout
}

is 'commands' gives 'papers pack params' pa
holds pack p && holds p1-set1-uniaxial p
result 'presets beside commands' $?
every_command() {
    "$greenbody" --commands | while read -r name _; do
        holds "$name" '' && holds --help "$name" -- || exit 1
    done
}
is 'every command, and the options of each' every_command
is 'options with a value' gives '--out=' run --o
is 'groups of keys' gives 'contact.' run default con
is 'keys' gives 'contact.mu= contact.mu_wall= contact.mu_pivot=' run default contact.mu
is 'keys typed without their group' gives \
    'contact.mu= contact.mu_wall= contact.mu_pivot=' run default mu
every_key() {
    "$greenbody" params --markdown | sed -n 's/^| `\([a-z0-9_.]*\)`.*/\1/p' >keys
    while read -r key; do
        holds "$key=" run default "$key" || exit 1
    done <keys
    [ "$(wc -l <keys)" -gt 80 ]
}
is 'every key' every_key
is 'choices' gives \
    'contact.normal=rod contact.normal=hertz contact.normal=storakers' \
    run default contact.normal=
is 'units behind a number' gives 'particles.diameter=10nm' run default \
    particles.diameter=10n
is 'parts of a varied list' gives 'contact.normal=rod;hertz' sweep default --vary \
    'contact.normal=rod;h'
is 'keys of a list' gives 'contact.mu,contact.alpha=' calibrate default --free \
    contact.mu,contact.al
is 'figures' gives 'heckel' plot --figure he
is 'formats' gives '--format=extxyz' export --format=e
is 'equations' gives 'heckel' fit --equation he
is 'laws' gives 'rod roll' law ro
is 'values of the options of the workbench' gives 'auto always' --color a
is 'a second preset is not offered' gives '' run default p1-s

mkdir -p runs/one runs/other/two '.hidden'
: >runs/one/preset.ini
: >runs/other/two/preset.ini
: >mine.ini
: >'with blank.csv'
: >x.h5
is 'run directories, and folders on the way' gives 'runs/one runs/other/' resume runs/o
is 'files of a preset' gives 'mine.ini' run mi
is 'files of an option by their ending' gives 'with blank.csv' plot --data w
is 'state files of export' holds x.h5 export x
is 'a short option takes the same value' holds runs/ run -o r
is 'no hidden folder' gives '' resume h

# bash as readline calls it: words cut at =, too
cat >line.bash <<'END'
source "$1/greenbody.bash"
compopt() { printf '(no space)\n'; }
read -ra COMP_WORDS <<<"$3"
COMP_LINE=$2 COMP_POINT=${#2} COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
[[ $2 == *' ' ]] && COMP_WORDS+=('') && ((++COMP_CWORD))
_greenbody
printf '%s\n' "${COMPREPLY[@]}"
END
in_bash() { # expected, line, its words
    PATH=$folder:$PATH bash line.bash "$scripts" "$2" "$3" >stdout 2>stderr
    [ "$(cat stdout)" = "$1" ]
}
is 'bash: a key' in_bash "(no space)
contact.normal=" 'greenbody run default contact.nor' 'greenbody run default contact.nor'
is 'bash: a choice' in_bash 'hertz' 'greenbody run default contact.normal=h' \
    'greenbody run default contact.normal = h'
is 'bash: right behind the sign' in_bash 'rod
hertz
storakers' 'greenbody run default contact.normal=' 'greenbody run default contact.normal ='
is 'bash: a name with a blank is quoted' in_bash 'with\ blank.csv' \
    'greenbody plot --data w' 'greenbody plot --data w'
is 'bash: a new word' in_bash 'runs/one' 'greenbody resume runs/on' \
    'greenbody resume runs/on'

skipped() { # shell
    tests=$((tests + 1))
    echo "ok $tests $1 # SKIP no $1 here"
}
if command -v fish >/dev/null; then
    in_fish() { # expected, line
        HOME=$here PATH=$folder:$PATH fish -c "source $scripts/greenbody.fish
            complete -C '$2'" 2>stderr | cut -f1 >stdout
        [ "$(tr '\n' ' ' <stdout)" = "$1 " ]
    }
    is 'fish: a key' in_fish 'contact.normal=' 'greenbody run default contact.nor'
    is 'fish: a choice' in_fish 'contact.normal=hertz' \
        'greenbody run default contact.normal=h'
else
    skipped fish
fi
if command -v zsh >/dev/null && command -v tmux >/dev/null; then
    printf 'fpath=(%s $fpath)\nautoload -Uz compinit\ncompinit -u -D\nPS1="Z> "\n' \
        "$scripts" >.zshrc
    screen="tmux -L greenbody-zsh-$$"
    $screen -f /dev/null new-session -d -x 120 -y 20 \
        "env HOME=$here ZDOTDIR=$here PATH=$folder:$PATH zsh -i"
    seen() { # text
        $screen capture-pane -p >stdout && grep -qF -- "$1" stdout
    }
    shows() { # text
        until_true seen "$1"
    }
    in_zsh() {
        shows 'Z>' && $screen send-keys 'greenbody run default contact.nor' Tab &&
            shows 'contact.normal=' && $screen send-keys h Tab &&
            shows 'contact.normal=hertz' && $screen send-keys mu_w Tab &&
            shows 'contact.mu_wall='
    }
    is 'zsh: a key, a choice, a key without its group' in_zsh
    $screen kill-server 2>/dev/null
else
    skipped zsh
fi
echo "1..$tests"
exit "$bad"
