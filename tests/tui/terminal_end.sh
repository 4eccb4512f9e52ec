#!/bin/sh
# A test that is stopped, by a limit of time, leaves no engine and no folder behind: neither the
# run of a terminal that was closed nor one without a terminal.
# Usage: terminal_end.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

# As a test begins, here with two runs that outlive what started them.
# shellcheck disable=SC2016  # for the inner shell
sh -c '. "$(dirname "$0")/terminal.sh"
echo "$here" >"$3/folder"
open_terminal
start "$long"
setsid "$greenbody" run $long --quiet --out "$here/run" >/dev/null 2>&1 &
until_true computes "$runs/default-1"
until_true has_rows "$here/run"
term kill-server
touch "$3/ready"
until_true false' "$0" "$greenbody" "$presets" "$here" >"$here/out" 2>&1 &
inner=$!
is 'two runs begin' until_true [ -e "$here/ready" ]
folder=$(cat "$here/folder")

pid_of() { # directory
    sed -n 's/.*"pid" : \([0-9]*\).*/\1/p' "$1/status.json"
}
without=$(pid_of "$folder/run")
closed=$(pid_of "$folder/state/greenbody/runs/default-1")

is 'the run of the closed terminal goes on' has_process "$closed"
is 'so does the one without' has_process "$without"

kill -TERM $inner
ended $inner
is 'the stopped test has failed' [ $? -eq 1 ]
is 'and said where' grep -q '^# stopped after test' "$here/out"
is 'the run of the closed terminal has ended' has_no_process "$closed"
is 'so has the one without' has_no_process "$without"
is 'and the folder is gone' [ ! -e "$folder" ]
for pid in $closed $without; do
    kill -KILL "$pid" 2>/dev/null
done
echo "1..$tests"
exit "$bad"
