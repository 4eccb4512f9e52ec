#!/bin/sh
# Nothing is lost and nothing read that was not written: a run of each kind, a resume, a
# snapshot and a session of the workbench under valgrind.
# Usage: valgrind.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/terminal.sh"

if ! command -v valgrind >/dev/null; then
    echo '1..0 # SKIP without valgrind'
    exit 0
fi

# The program starts itself anew to set this; valgrind cannot follow there.
patience_s=$((patience_s * 4)) # and is thirty times as slow
suppressed=$(cd "$(dirname "$0")/.." && pwd)/valgrind.supp
cd "$here" || exit 1
cat >checked <<END
#!/bin/sh
exec valgrind -q --leak-check=full --errors-for-leak-kinds=definite,possible \
    --show-leak-kinds=definite,possible --suppressions='$suppressed' --error-exitcode=99 \
    --log-file='$here/log' '$greenbody' "\$@"
END
chmod +x checked

clean() { # name, words...: ends well, and valgrind has nothing to say
    name=$1
    shift
    ./checked "$@" >out 2>&1 && [ ! -s log ]
    result "$name" $?
    [ "$bad" -eq 0 ] || sed 's/^/# /' log out
}

small='default particles.count=60 structure.base=auto loading.step=0.6%'
# shellcheck disable=SC2086  # a list of words
clean 'a run at rest' run $small 'loading.until=8 MPa' 'loading.unload_from=3 MPa' \
    output.snapshots_at='every 5' numerics.threads=2 --quiet --out rest
clean 'a run in motion' run p2-v1 particles.count=60 loading.relax='0.001 ns' \
    loading.hold='0.001 ns' loading.record='1 %' loading.until='density = 0.7' \
    --yes --quiet --out motion
clean 'a run in a die' run p3-hertz-mu0 particles.count=15 loading.until='5 MPa' \
    numerics.fidelity=fast --yes --quiet --out die

# Stopped at its first checkpoint beyond some points, then resumed.
# shellcheck disable=SC2086
"$greenbody" run $small loading.until='300 MPa' loading.unload_from= loading.step=0.15% \
    output.checkpoint_every='0.1 s' numerics.fidelity=reference --quiet --out stopped >out 2>&1 &
has_points() {
    [ -e stopped/state.h5 ] && [ "$(grep -vc '^#' stopped/curve.csv)" -gt 5 ]
}
until_true has_points
kill -TERM $!
ended $!
is 'a run stopped by TERM says so' [ $? -eq 143 ]
clean 'a resumed run' resume --quiet stopped
if "$greenbody" snapshot rest -o trial.png >out 2>&1; then
    clean 'a snapshot' snapshot rest -o picture.png
    clean 'a picture of the directions of forces' snapshot rest -o rose.png --rose
fi
clean 'a figure' plot rest --figure densification -o figure.png

greenbody=$here/checked
open_terminal
# shellcheck disable=SC2086
start $small loading.until="'200 MPa'" loading.unload_from=
shows 'the workbench opens' 'Pressure against relative density'
shows 'its run comes to its end' '✓ done'
for key in 2 3 4 1 '?' Escape Tab; do
    keys "$key"
done
is 'focus reaches mu' go_to mu
keys Enter C-u 0.3 Enter
is 'the full cell follows' until_true [ -e "$here/state/greenbody/runs/default-2/curve.csv" ]
keys q
until_true asks_or_has_left
has 'status=' || keys y
shows 'q leaves the workbench' 'status='
is 'nothing was lost in it' has 'status=0'
[ ! -s log ]
result 'and nothing to be said of it' $?
sed 's/^/# /' log

echo "1..$tests"
exit "$bad"
