#!/bin/sh
# Names of files and folders, titles and contents of files cannot drive the terminal: what the
# program prints of them has visible escapes for control characters.
# Usage: escapes.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

own="$here/config/greenbody/presets"
mkdir -p "$own"
small="particles.count=100 numerics.fidelity=fast loading.unload_from= loading.until=5MPa"

# No control character but the end of a line and the tab: of ASCII, of C1 in UTF-8 or bare (no
# text here has the byte 0x9b as a part of a character).
harmless() { # files
    cat "$@" | LC_ALL=C tr -d '\n\t' | LC_ALL=C tr -dc '\000-\037\177\233' >controls
    [ ! -s controls ] && ! LC_ALL=C grep -q "$(printf '\302[\200-\237]')" "$@"
}

# name, the escape shown (a fixed text, or ''), expected status, command
printed() {
    name=$1
    wanted=$2
    expected=$3
    shift 3
    in_patience "$@" >stdout 2>stderr </dev/null
    status=$?
    cat stdout stderr >both
    [ $status -eq "$expected" ] && harmless stdout stderr && { [ -z "$wanted" ] || grep -qF -- "$wanted" both; }
    good=$?
    if [ $good -ne 0 ]; then
        echo "# status $status, expected $expected, and $wanted"
        od -c both | sed 's/^/# /' | head -n 20
        : >stdout
        : >stderr
    fi
    result "$name" $good
}

interrupted() { # name, the event that is waited for, command: stopped then, with its directory
    name=$1
    event=$2
    shift 2
    : >stderr
    "$@" >stdout 2>>stderr </dev/null &
    pid=$!
    until_true sh -c "$event"
    kill -TERM $pid
    ended $pid
    [ $? -eq 143 ] && harmless stdout stderr && grep -qF 'in stop\x1b[31m' stderr
    result "$name" $?
}

# what, its bytes, what is shown of them
while read -r what bytes shown; do
    # shellcheck disable=SC2059  # the bytes are a format
    evil=$(printf "$bytes")
    cp "$presets/default.ini" "$own/p$evil.ini"
    # shellcheck disable=SC2086  # words
    set -- $small
    printed "$what: --help lists the preset" "p$shown" 0 "$greenbody" --help
    printed "$what: no such preset" "nothing$shown" 2 "$greenbody" run "nothing$evil" "$@"
    printed "$what: no such word" "nothing$shown" 2 "$greenbody" "nothing$evil"
    printed "$what: no such option" "nothing$shown" 2 "$greenbody" run "--nothing$evil"
    printed "$what: a default directory" "runs/p$shown-1" 0 "$greenbody" run "p$evil" "$@"
    printed "$what: a directory" "out$shown" 0 "$greenbody" run default "$@" --json \
        -o "out$evil"
    printed "$what: a directory with a run" "out$shown" 2 "$greenbody" run default "$@" \
        -o "out$evil"
    printed "$what: attach" "out$shown" 0 "$greenbody" attach "out$evil"
    printed "$what: attach to nothing" "no$shown" 2 "$greenbody" attach "no$evil"
    printed "$what: resume of a run that is done" "out$shown" 0 "$greenbody" resume "out$evil"
    printed "$what: verify" '' 0 "$greenbody" verify "out$evil"
    printed "$what: figures as CSV" '' 0 "$greenbody" plot "out$evil" --figure densification
    printed "$what: fits" '' 0 "$greenbody" fit "out$evil"
    printed "$what: export" '' 0 "$greenbody" export "out$evil" --format extxyz -o "file$evil.xyz"
    printed "$what: report" '' 0 "$greenbody" report "out$evil" -o "report$evil"
    grep -qF "out$(printf '%s' "$shown" | sed 's/[][\\]/\\&/g')" "report$evil/report.md" &&
        harmless "report$evil/report.md" "report$evil/index.html"
    result "$what: its page" $?
    printed "$what: a report that exists" "report$shown" 2 "$greenbody" report "out$evil" \
        -o "report$evil"
    printed "$what: sweep" '' 0 "$greenbody" sweep "p$evil" "$@" \
        --vary 'mu=0.1,0.3' --at 5MPa -o "sweep$evil"
    printed "$what: sweep over a run" "out$shown" 2 "$greenbody" sweep default "$@" \
        --vary 'mu=0.1,0.3' -o "out$evil"
    printed "$what: attach to a sweep" '2 runs' 0 "$greenbody" attach "sweep$evil"
    printed "$what: the packing alone" "pack$shown" 0 "$greenbody" pack default "$@" \
        -o "pack$evil"
    printed "$what: a value" "$shown" 2 "$greenbody" run default "contact.mu=0.1$evil"
    printed "$what: --diagnose" "kept$shown" 0 "$greenbody" --diagnose --runs "kept$evil"
    printf '[scene]\ntitle = a%sb\n' "$evil" >title.ini
    printed "$what: a title" "$shown" 2 "$greenbody" run title.ini
    printf 'density,p%s\n0.5,1\n' "$evil" >"data$evil.csv"
    printed "$what: measured data" "$shown" 2 "$greenbody" fit "data$evil.csv"
    printed "$what: completion" 'default' 0 "$greenbody" --complete run ''
    rm "$own/p$evil.ini"
done <<'TABLE'
title \033]0;x\007 \x1b]0;x\x07
colour \033[31m \x1b[31m
return a\rb a\x0db
C1 \302\23331m \u009b31m
byte \23331m \x9b31m
TABLE

# Letters stay.
printed 'letters of other scripts' "Größe粉-1" 0 "$greenbody" run default \
    particles.count=100 numerics.fidelity=fast loading.unload_from= loading.until=5MPa \
    -o 'Größe粉-1'

# --- stopped and resumed --------------------------------------------------------------------
directory=$(printf 'stop\033[31m')
interrupted 'a run that is stopped' 'grep -qs "^load,[1-9]" stop*/curve.csv' \
    "$greenbody" run default particles.count=2000 'loading.until=5 GPa' -o "$directory"
interrupted 'and resumed' 'grep -q "resumed from" stderr' "$greenbody" resume "$directory"

# --- the one place ----------------------------------------------------------------------------
source=$(dirname "$presets")/src
grep -rnE '\<(v?f?printf|puts|fputs|putchar|putc|fputc|fwrite|perror|g_print|g_printerr)\(' \
    "$source/cli" "$source/tui" --include='*.c' |
    grep -v 'tui/term/term\.c:' >raw
is 'all that is printed goes through visible.h' [ ! -s raw ]
[ ! -s raw ] || sed 's/^/# /' raw

echo "1..$tests"
exit $bad
