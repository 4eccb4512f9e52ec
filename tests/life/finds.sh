#!/bin/bash
# What the random life finds: stand-ins for the program that break one promise each.
# Usage: finds.sh GREENBODY PRESET_FOLDER RANDOM_LIFE.py LEAP_CLOCK_SO SAME_STATE
. "$(dirname "$0")/../cli/folder.sh"

life=$3
same_state=$5

# A stand-in: the program, after whose work a line of shell is run ($@ its words, $status).
stand_in() { # line of shell
    cat >broken.sh <<END
#!/bin/bash
"$greenbody" "\$@"
status=\$?
out=\${*: -1}
$1
exit \$status
END
    chmod +x broken.sh
}

found() { # name, pattern of why.txt, seed, line of shell, seconds to make it smaller to 3 steps
    stand_in "$4"
    rm -rf kept
    python3 "$life" --seed "$3" --cases 1 --shrink "${5:-0}" --enough 3 --keep kept --same-state "$same_state" \
        ./broken.sh "$presets" >stdout 2>stderr
    [ $? -eq 1 ] && grep -q "^$2: " "kept/failed-$3/why.txt" && grep -q "^$3 failed" kept/seeds.log
    result "$1 is found" $?
}

# shellcheck disable=SC2016  # for the stand-in
found 'a status that is not documented' 'exit status' 8 '[ "$1" != run ] || status=4'
# shellcheck disable=SC2016
found 'two lines for a failure' 'one line per failure' 8 \
    '[ "$1" != run ] || { printf "a\nb\n" >&2; status=1; }'
# shellcheck disable=SC2016
found 'a density of 1' density 8 \
    '[ "$1" != run ] || sed -i "\$s/\(load,[0-9]*\),[^,]*/\1,1/" "$out/curve.csv"'
# shellcheck disable=SC2016
found 'a number that is none' 'finite columns' 8 \
    '[ "$1" != run ] || sed -i "\$s/\(load,[0-9]*,[^,]*\),[^,]*/\1,nan/" "$out/curve.csv"'
# a scene with inertia: work is column 17 of its curve, a velocity column 13 of its particles
# shellcheck disable=SC2016
found 'energy from nowhere' energy 52 '[ "$1" != run ] || {
    awk -F, -v OFS=, "/^load/ { \$17 *= 2 } 1" "$out/curve.csv" >more && mv more "$out/curve.csv"; }'
# shellcheck disable=SC2016
found 'momentum from nowhere' momentum 52 '[ "$1" != export ] || {
    awk -F, -v OFS=, "/^1,/ { \$13 += 1000 } 1" particles.csv >more && mv more particles.csv; }'
# shellcheck disable=SC2016
found 'a file that is left behind' files 8 '[ "$1" != run ] || touch "$out/state.h5.ab12cd"'
# shellcheck disable=SC2016
found 'a row that resume changes' '.*rows' 36 \
    '[ "$1" != resume ] || sed -i "\$s/,0\.\([0-9]\)/,0.9\1/" "$out/curve.csv"' "$patience_s"
steps=$(grep -c '"do"' kept/failed-36/case.json)
is 'and its case is made smaller' [ "$steps" -lt 4 ]
kept/failed-36/replay.sh >stdout 2>stderr
is 'its script repeats the failure' [ $? -eq 1 ]
cp "$greenbody" broken.sh 2>/dev/null
kept/failed-36/replay.sh >stdout 2>stderr
is 'and passes with the program itself' [ $? -eq 0 ]

# A seed that is done is not done again.
printf '8 ok 1.0 s\n' >seeds
mkdir -p again && cp seeds again/seeds.log
python3 "$life" --seed 8 --cases 1 --keep again --same-state "$same_state" "$greenbody" \
    "$presets" >stdout 2>stderr
is 'the next seed follows' [ "$(cut -d' ' -f1 again/seeds.log | tr '\n' ' ')" = '8 9 ' ]

echo "1..$tests"
exit $bad
