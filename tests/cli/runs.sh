#!/bin/sh
# The list of runs, and attach without a directory.
# Usage: runs.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

export XDG_STATE_HOME="$here/state"
kept="$here/state/greenbody/runs"
small='default particles.count=60 loading.until=0.1MPa loading.unload_from='
long='default particles.count=6000 loading.step=0.02% numerics.fidelity=reference'

says() { # pattern
    grep -q -- "$1" stdout
}

list() { # words
    "$greenbody" runs "$@" >stdout 2>stderr
}

engines() { # the engine of a run by its name, from --json
    list --json && python3 -c 'import json, sys
print([r["engine"] for r in json.load(open("stdout"))["runs"] if r["name"] == sys.argv[1]])' "$1"
}

engine_is() { # name, engine
    [ "$(engines "$1")" = "['$2']" ]
}

has_rows() { # directory
    grep -qs '^load,[2-9]' "$1/curve.csv"
}

# --- none, and past ones
is 'no runs are no error' list
is 'which is told' grep -q 'no runs below .*state/greenbody/runs and ./runs' stderr
is 'nothing is printed' [ ! -s stdout ]
list --json
is 'an empty list in JSON' says '"runs" : \[ *\]'
# shellcheck disable=SC2086  # words
"$greenbody" run $small --quiet --out "$kept/done-1" >stdout 2>stderr
# shellcheck disable=SC2086
"$greenbody" run $small --quiet >stdout 2>stderr # runs/default-1
# shellcheck disable=SC2086
"$greenbody" sweep $small --vary contact.mu=0.1,0.2 --quiet --out "$kept/set" >stdout 2>stderr
is 'runs are listed' list
is 'with a head' says '^name .*state .*density .*pressure .*size .*date'
is 'a run of the workbench by its name' says '^done-1  *done  *0\.[0-9]*  *[0-9.]* kPa  *[0-9.]* kB  [0-9]'
is 'one of the working folder by its path' says '^runs/default-1  *done'
is 'in 80 columns' eval '[ "$(wc -L <stdout)" -le 80 ]'
is 'those of a sweep below its name' [ "$(grep -c '^set/' stdout)" -eq 2 ]
is 'a folder that is named' list "$here/runs"
is 'has its own only' eval 'says "^default-1 " && [ "$(wc -l <stdout)" -eq 2 ]'
list "$here/none"
is 'a folder that is none is refused' eval '[ $? -eq 2 ] || grep -q "expected a folder" stderr'
"$greenbody" report "$here/runs/default-1" -o "$kept/report" >stdout 2>stderr
is 'a report has the preset of its run' [ -s "$kept/report/preset.ini" ]
is 'and is no run' eval 'list && ! says "^report"'
mkdir -p "$kept/broken"
echo nonsense >"$kept/broken/preset.ini"
is 'a broken one is listed' eval 'list && says "^broken  *unreadable"'
list --json
is 'JSON has numbers' python3 -c 'import json, os
runs = {r["name"]: r for r in json.load(open("stdout"))["runs"]}
done = runs["done-1"]
assert done["state"] == "done" and done["engine"] == "none", done
assert 0.2 < done["density"] < 0.6 and done["pressure_MPa"] > 0.09, done
assert done["bytes"] > 1000 and done["modified"].endswith("Z"), done
assert os.path.isdir(done["directory"]) and done["title"] != "", done
assert runs["broken"]["density"] is None, runs'

# --- folders that overlap, and words that a spreadsheet would compute
rm -rf twice
"$greenbody" run default 'scene.title==1+1,=2+2' particles.count=100 'loading.until=5 MPa' \
    loading.unload_from= --quiet --out twice/one >stdout 2>stderr
is 'a run with a formula for a title' [ $? -eq 0 ]
lists_once() { # folders
    "$greenbody" runs "$@" >stdout 2>stderr
    [ "$(grep -c 'one  *done' stdout)" -eq 1 ]
}
is 'a folder given twice is listed once' lists_once twice twice
is 'also by two paths' lists_once twice ./twice/../twice "$PWD/twice"
is 'also within one another' lists_once . twice twice/one/..
"$greenbody" sweep default 'scene.title==1+1,=2+2' particles.count=100 'loading.until=5 MPa' \
    loading.unload_from= --vary 'material.name==1+1;@x;+y;-z' --replicas 1 --quiet \
    --out twice/sweep >stdout 2>stderr
"$greenbody" plot twice/one --figure densification -o twice/f.svg >stdout 2>stderr
"$greenbody" export twice/one/state.h5 --format=csv -o twice/e.csv >stdout 2>stderr
is 'no table has a formula' python3 -c 'import glob, re, sys
tables = glob.glob("twice/**/*.csv", recursive=True)
assert len(tables) > 8, tables
for path in tables:
    for line in open(path):
        for cell in re.split("[,;\t]", line.strip("\n")):
            cell = cell.strip(" \"")
            if cell[:1] in tuple("=+-@") and cell:
                float(cell.split()[0])'

# --- attach without a run
"$greenbody" attach >stdout 2>stderr
is 'attach without a live run is refused' [ $? -eq 2 ]
is 'with what is expected' grep -q 'no run is live below .*expected a run directory' stderr

# --- live ones: a process without a terminal is detached
# shellcheck disable=SC2086
setsid "$greenbody" run $long --quiet --out "$kept/first" >live.out 2>&1 &
until_true has_rows "$kept/first"
is 'one without a terminal is detached' until_true engine_is first detached
is 'and comes first' eval 'list && sed -n 2p stdout | grep -q "^first  *detached [0-9]* %"'
"$greenbody" attach >stdout 2>stderr
is 'attach without a terminal and directory is refused' [ $? -eq 2 ]
is 'and names the live run' grep -q '1 live, the newest in .*/first' stderr
pid=$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["pid"])' "$kept/first/status.json")
kill -KILL "$pid"
is 'killed, it is interrupted' until_true eval 'list && says "^first  *interrupted  *0"'
ended $!

echo "1..$tests"
exit "$bad"
