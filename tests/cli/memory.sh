#!/bin/sh
# A run whose memory is out at any moment, in the structure, the lists or a checkpoint: one line and
# the exit status of a machine's trouble, never a signal.
# Usage: memory.sh GREENBODY PRESET_FOLDER
script=$(realpath "$0")
. "$(dirname "$0")/folder.sh"

limited() { # kilobytes of address space
    rm -rf run
    (
        ulimit -v "$1"
        exec "$greenbody" run p1-set2-9.7nm particles.count=50000 loading.until=density=0.245 \
            loading.unload_from= numerics.fidelity=fast numerics.threads=1 --quiet --out run
    ) >stdout 2>stderr
}

# The least with which the program starts at all depends on its libraries.
least=100000
until (ulimit -v $least && exec "$greenbody" --version) >stdout 2>stderr; do
    least=$((least + 20000))
done
short=0
whole=0
more=2000
while [ $whole -lt 2 ] && [ $more -lt 500000 ]; do
    limited $((least + more))
    status=$?
    [ $status -eq 0 ] || [ $status -eq 3 ]
    result "with $more kB more than the program: 0 or 3" $?
    if [ $status -eq 3 ]; then
        short=$((short + 1))
        is 'one line says why' [ "$(wc -l <stderr)" -eq 1 ]
        is 'the word is memory' grep -q memory stderr
    else
        whole=$((whole + 1))
    fi
    more=$((more + 4000))
done
is 'memory was out in some of them' [ $short -gt 2 ]
is 'and was enough in others' [ $whole -eq 2 ]

echo "1..$tests"
exit $bad
