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

# Names with every character that can be typed: what a shell makes of a candidate is the name.
mkdir -p every
for code in $(seq 32 126); do
    character=$(printf "\\$(printf %03o "$code")x")
    [ "$character" = /x ] || mkdir "every/r${character%x}n"
done
for folder in every/*; do
    : >"$folder/preset.ini"
done
(cd every && printf '%s\n' *) | LC_ALL=C sort >names
cat >every.bash <<'END'
source "$1/greenbody.bash"
compopt() { :; }
quote=$2
COMP_LINE="greenbody resume ${quote}every/r"
COMP_POINT=${#COMP_LINE}
COMP_WORDS=(greenbody resume "${quote}every/r") COMP_CWORD=2
_greenbody
for reply in "${COMPREPLY[@]}"; do
    eval "set -- $quote$reply$quote"
    printf '%s\n' "${*#every/}"
done
END
every_name() { # quote that is open
    PATH=$folder_of_program:$PATH bash every.bash "$scripts" "$1" 2>stderr | LC_ALL=C sort >stdout
    [ "$(wc -l <names)" -eq 94 ] && cmp -s names stdout && [ ! -s stderr ] && [ ! -e n ]
}
folder_of_program=$(dirname "$greenbody")
is 'bash: every character of a name' every_name ''
is 'bash: in single quotes' every_name "'"
is 'bash: in double quotes' every_name '"'
in_bash_expansion() {
    # shellcheck disable=SC2016  # for the shell under test
    for word in '$(' '`' '>r' 'r>' '"$x'; do
        in_bash '' "greenbody resume $word" "greenbody resume $word" || return 1
    done
}
is 'bash: what the shell would expand has no candidates' in_bash_expansion

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
    folder=$folder_of_program
    is 'fish: a key' in_fish 'contact.normal=' 'greenbody run default contact.nor'
    is 'fish: a choice' in_fish 'contact.normal=hertz' \
        'greenbody run default contact.normal=h'
else
    skipped fish
fi

# Shells in a terminal.  A stand-in of the program writes the words that it gets.
mkdir -p stand-in "$XDG_CONFIG_HOME/greenbody/presets"
cat >stand-in/greenbody <<END
#!/bin/sh
[ "\$1" = --complete ] && exec '$greenbody' "\$@"
printf '%s\n' "\$@" END >'$here/words'
END
chmod +x stand-in/greenbody
n=10
: >evil
# shellcheck disable=SC2016  # names
for name in 'run`>PWNED`' 'run$(>PWNED)' 'run;>PWNED' 'run"`>PWNED`"' "run'>PWNED'" 'run!!' \
    'run *{a,b}?[c]#~' 'run\`>PWNED`' 'run|tee PWNED'; do
    n=$((n + 1))
    mkdir "$here/r$n$name"
    : >"$here/r$n$name/preset.ini"
    : >"$XDG_CONFIG_HOME/greenbody/presets/p$n$name.ini"
    printf '%s\n' "$n$name" >>evil
done
screen=: # the terminal of the shell
seen() { # text
    $screen capture-pane -p >stdout && grep -qF -- "$1" stdout
}
shows() { # text
    until_true seen "$1"
}
opens() { # command that starts the shell
    $screen kill-server 2>/dev/null
    screen="tmux -L greenbody-completion-$$-$tests" # a server that ends keeps its name for a while
    $screen -f /dev/null new-session -d -x 120 -y 20 \
        "env HOME='$here' ZDOTDIR='$here' HISTFILE=/dev/null PATH='$here/stand-in:$PATH' $1"
    shows 'Z>'
}
gets() { # the words that the program got
    [ -s words ] && printf '%s\n' "$@" END | cmp -s - words
}
# Tab and Enter after the beginning of each name give the program the name.
each_evil() { # command, letter of the names, quote that is open
    while read -r evil; do
        rm -f words
        $screen send-keys -l "greenbody $1 $3$2$(printf %.2s "$evil")"
        $screen send-keys Tab
        until_true completed || return 1
        $screen send-keys Enter
        until_true gets "$1" "$2$evil" || return 1
        $screen send-keys C-l
        [ ! -e PWNED ] || return 1
    done <evil
}
completed() { # the letters of the rest of a name are on the line
    $screen capture-pane -p >stdout && grep -q 'Z> .*[0-9][0-9]run' stdout
}
in_terminal() { # shell, command that starts it
    is "$1: it starts" opens "$2"
    for quote in '' "'" '"'; do
        is "$1: Tab and Enter take folders literally, after '$quote'" each_evil resume r "$quote"
    done
    is "$1: and presets" each_evil run p ''
}
printf 'PS1="Z> "\nsource %s/greenbody.bash\n' "$scripts" >.bashrc
printf 'fpath=(%s $fpath)\nautoload -Uz compinit\ncompinit -u -D\nPS1="Z> "\n' \
    "$scripts" >.zshrc
printf 'source %s/greenbody.fish\nfunction fish_prompt\n    echo "Z> "\nend\n' "$scripts" >fishrc
for shell in bash zsh fish; do
    if ! command -v "$shell" >/dev/null || ! command -v tmux >/dev/null; then
        skipped "$shell with tmux"
        continue
    fi
    case $shell in
    bash) in_terminal bash "bash --rcfile '$here/.bashrc' -i" ;;
    zsh) in_terminal zsh 'zsh -i' ;;
    fish) in_terminal fish "fish -C 'source $here/fishrc'" ;;
    esac
done
if command -v zsh >/dev/null && command -v tmux >/dev/null; then
    in_zsh() {
        opens 'zsh -i' && $screen send-keys 'greenbody run default contact.nor' Tab &&
            shows 'contact.normal=' && $screen send-keys h Tab &&
            shows 'contact.normal=hertz' && $screen send-keys mu_w Tab &&
            shows 'contact.mu_wall='
    }
    is 'zsh: a key, a choice, a key without its group' in_zsh
fi
$screen kill-server 2>/dev/null
echo "1..$tests"
exit "$bad"
