#!/bin/sh
# The ten tasks of docs/manual.md by just the keys of its table, in a terminal of 80 x 24: what each
# one leaves on the screen and in files, and how many keys it takes.
# Usage: ten_tasks.sh GREENBODY PRESET_FOLDER MANUAL.md
. "$(dirname "$0")/terminal.sh"

manual=$3

# The keys of a row of the table between two ellipses, one a line, in hexadecimal or a name of tmux.
keys_of() { # task, part from 1
    python3 - "$manual" "$1" "$2" <<'END'
import re, sys
manual, task, part = sys.argv[1], sys.argv[2], int(sys.argv[3])
names = {'Enter': 'Enter', 'Tab': 'Tab', 'Esc': 'Escape', 'Ctrl-U': 'C-u', 'Del': 'DC',
         'Left': 'Left', 'Right': 'Right', 'Up': 'Up', 'Down': 'Down'}
rows = [row.split(' | ') for row in open(manual, encoding='utf-8') if row.startswith(f'| {task} | ')]
rows = [row for row in rows if len(row) == 4]
assert len(rows) == 1, rows
for literal, word in re.findall(r'`([^`]*)`|(\S+)', rows[0][2].split('…')[part - 1]):
    for key in literal:
        print(f'-H {ord(key):x}')
    if word:
        print(names[word])
END
}

# What was left going ends with the test.
stop_runs() {
    for status in "$runs"/*/status.json; do
        pid=$(python3 -c 'import json, sys
print(json.load(open(sys.argv[1]))["pid"])' "$status" 2>/dev/null) &&
            kill -KILL "$pid" 2>/dev/null
    done
}

begin_task() { # number, what it does
    task=$1
    what=$2
    part=0
    pressed=0
}

press() { # the keys of the next part
    part=$((part + 1))
    keys_of "$task" "$part" >"$here/keys" || return 1
    while read -r key; do
        # shellcheck disable=SC2086  # an option and its word
        keys $key
        pressed=$((pressed + 1))
    done <"$here/keys"
}

seen() { # pattern
    shows "$what: $1" "$1"
}

# All parts are pressed, as often as the table says, and 15 times at most.
end_task() {
    row=$(grep "^| $task | .* | [0-9]* |$" "$manual")
    parts=$(printf '%s\n' "$row" | grep -o '…' | wc -l)
    [ "$part" -eq $((parts + 1)) ]
    result "$what: all of its keys" $?
    [ "$pressed" -eq "$(printf '%s\n' "$row" | sed 's/.*| \([0-9]*\) |$/\1/')" ]
    result "$what: as many as the manual says" $?
    [ "$pressed" -le 15 ]
    result "$what: at most 15" $?
}

reads() { # text that may be wrapped
    screen | tr -s '\n │' '  ' | grep -q -- "$1"
}

is_there() { # pattern of a path below the runs
    [ -n "$(find "$runs" -path "$1" -size +0)" ]
}

# The head of a PNG file, and its pixels per metre where it has them.
is_8_cm_wide() {
    python3 - "$(find "$runs" -name 'picture-1.png' -size +0)" <<'END'
import struct, sys
png = open(sys.argv[1], 'rb').read()
wide, = struct.unpack('>I', png[16:20])
at = png.index(b'pHYs') + 4
per_metre, _, metre = struct.unpack('>IIB', png[at:at + 9])
assert metre == 1 and abs(wide / per_metre - 0.08) < 1e-4, (wide, per_metre, metre)
END
}

draws() {
    ! "$greenbody" --version | grep -q 'no pictures'
}

has_more_rows() { # than before
    [ "$(wc -l <"$runs/default-1/curve.csv")" -gt "$1" ]
}

cd "$here" || exit 1
open_terminal
keys "cd '$here'" Enter
start default particles.count=200 loading.until=150MPa loading.unload_from=
shows "opens" '✓ done'

begin_task 1 'change mu and see it'
press
seen '^ mu  *0\.3 '
seen 'run 2 started'
seen '✓ done'
seen 'a mu 0\.1'
end_task

begin_task 2 'compare three values at 100 MPa'
press
seen 'run 3 started'
seen '✓ done'
press
seen 'run 4 started'
seen '✓ done'
press
seen 'Densities of the curves'
seen '100 MPa'
is "$what: three curves" until_true eval "[ \"\$(screen | grep -c '│ [a-z].* 0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]* ')\" -ge 3 ]"
seen '+- cell .* 0\.0'
seen '│ *- run .*[0-9][~!]'
end_task
keys Escape

begin_task 10 'undo twice'
press
seen 'undo: mu 0\.[0-9]*; 1 more'
seen '^ mu  *0\.3 '
seen '✓ done'
end_task

printf 'Druck (MPa);Dichte (%%)\n20;29,5\n50;33,1\n100;37,2\n' >lab.csv
begin_task 3 'a spreadsheet over the curve, and a fit'
press
seen 'measured, RMS misfit'
press
is "$what: the fit has a table" until_true is_there '*calibration.csv'
seen 'Result: calibration'
end_task

begin_task 4 'replicas to 0.002'
press
told "$what: they end" 'replicas saved'
seen 'Result: replicas'
keys Escape # the card lies over the legend
seen 'mean of [0-9]* cells'
end_task

begin_task 8 'report'
press
is "$what: a page" until_true is_there '*/report*.md'
seen 'Result: report'
end_task
leaves "quits before the chart"

start default particles.count=60 loading.until=20MPa loading.unload_from=
shows "a smaller one, whose chart is quick" 'N 60 .*✓ done'
begin_task 6 'accuracy against cost, and apply'
press
seen 'density error bound'
press
told "$what: the setting" 'setting of the chart: '
end_task
keys X
told "$what: it is stopped" 'chart: \(cancelled\|stopped\)'
is "$what: the setting has run" until_true has '[✓!] done'

begin_task 7 'a picture 8 cm wide of forces'
press
if draws; then
    seen 'Result: picture'
    seen 'in print 8 x [0-9.]* cm at 300 pixels per inch'
    is "$what: it is so wide" is_8_cm_wide
fi
end_task
leaves "quits"

rm -rf "$runs"
start "$long"
is "a run is under way" until_true computes "$runs/default-1"
begin_task 5 'what-if'
press
told "$what: it goes on from a point" 'changed after step'
end_task
leaves "quits, again"

mkdir bin
ln -s "$greenbody" bin/greenbody
keys "PATH='$here/bin':\$PATH exec bash --norc --noprofile" Enter
keys ". '$presets/../src/cli/completions/greenbody.bash'; PS1='bash''> '; clear" Enter
until_true has 'bash>'
rm -rf "$runs"
start "$long"
is "another run is under way" until_true computes "$runs/default-1"
begin_task 9 'detach and find it again'
press
seen 'status=0'
before=$(wc -l <"$runs/default-1/curve.csv")
is "$what: it goes on" until_true has_more_rows "$before"
press
seen '1 run, 1 live'
press
seen '▶ running'
end_task
leaves "leaves the run"
stop_runs

echo "1..$tests"
exit "$bad"
