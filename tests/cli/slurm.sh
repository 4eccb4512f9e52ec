#!/bin/bash
# Sweeps under a real Slurm of one node, started here in a folder of its own: an array, srun
# with every --mpi, a task that is cancelled in the middle, requeue and a limit of time.  The
# tables are those of one process.  Skipped without slurmctld, slurmd, munged or root.
# Usage: slurm.sh GREENBODY PRESET_FOLDER
. "$(dirname "$0")/folder.sh"

skip() { # reason
    echo "1..0 # SKIP $1"
    exit 0
}

for program in slurmctld slurmd munged sbatch srun; do
    command -v $program >/dev/null || skip "no $program here (Debian: slurm-wlm, munge)"
done
[ "$(id -u)" -eq 0 ] || skip 'slurmd has to be started by root'

# --- a cluster of this machine ------------------------------------------------------------
daemons() { # their numbers
    cat "$here"/slurm/{slurmd,slurmctld,munged}.pid 2>/dev/null
}

end_cluster() {
    scancel -u root 2>/dev/null
    for pid in $(daemons); do
        kill "$pid" 2>/dev/null
    done
    for pid in $(daemons); do
        timeout 20 tail --pid="$pid" -f /dev/null
        kill -KILL "$pid" 2>/dev/null
    done
    end_engines
    rm -rf "$here"
}
trap end_cluster EXIT

host=$(hostname -s)
port() { # one that is free now
    python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
mkdir -p slurm/state slurm/spool slurm/munge
chmod 0755 "$here" slurm
chmod 0700 slurm/munge
dd if=/dev/urandom bs=1 count=1024 of=slurm/munge/key 2>/dev/null
chmod 0600 slurm/munge/key
export SLURM_CONF="$here/slurm/slurm.conf"
cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$here/slurm/munge/socket
CredType=cred/munge
SlurmctldPort=$(port)
SlurmdPort=$(port)
StateSaveLocation=$here/slurm/state
SlurmdSpoolDir=$here/slurm/spool
SlurmctldPidFile=$here/slurm/slurmctld.pid
SlurmdPidFile=$here/slurm/slurmd.pid
SlurmctldLogFile=$here/slurm/slurmctld.log
SlurmdLogFile=$here/slurm/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
JobRequeue=1
KillWait=5
OverTimeLimit=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
is_idle() {
    [ "$(timeout 20 sinfo -h -t idle -o %D 2>/dev/null)" = 1 ]
}
patience_before=$patience_s
patience_s=120
munged --key-file="$here/slurm/munge/key" --socket="$here/slurm/munge/socket" \
    --pid-file="$here/slurm/munged.pid" --log-file="$here/slurm/munge/log" \
    --seed-file="$here/slurm/munge/seed" --force 2>stderr &&
    slurmctld 2>stderr && slurmd 2>stderr && until_true is_idle 2>>stderr ||
    skip "Slurm does not start here: $(cat stderr slurm/slurmd.log 2>/dev/null | tail -n 1)"
patience_s=$patience_before

# --- jobs ---------------------------------------------------------------------------------
sweep="'$greenbody' sweep p1-nobridge-38nm particles.count=PARTICLES structure.base=auto \
'loading.until=5 MPa' loading.unload_from= numerics.fidelity=fast \
--vary 'contact.mu=0.1;0.3' --replicas 6 --at '2;5 MPa'"

# Lines of a job are words of sbatch, then of the sweep.
submit() { # particles, words for sbatch, the command in place of the sweep's name, more for it
    cat >job <<JOB
#!/bin/sh
#SBATCH --output=$here/%A_%a.out
$3 ${sweep/PARTICLES/$1} $4
JOB
    # shellcheck disable=SC2086  # a list of words
    job=$(timeout 60 sbatch --parsable $2 job 2>stderr)
}

state() { # of all tasks of $job, one a line
    timeout 60 scontrol show job "$job" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p'
}

job_is_over() {
    local left
    left=$(timeout 60 squeue -h -j "$job" -o %T 2>/dev/null) && [ -z "$left" ]
}

over() { # name: waits for the end of the job
    until_true job_is_over
    is "$1: the job ends" [ $? -eq 0 ]
}

as_one() { # name, directory
    is "$1: the table of one process" cmp one/sweep.csv "$2/sweep.csv"
    is "$1: its list of runs" cmp one/runs.csv "$2/runs.csv"
    is "$1: nothing is left running" until_true none_works "$2"
}

eval "in_patience ${sweep/PARTICLES/100} --out one" >stdout 2>stderr
is 'one process' [ $? -eq 0 ]

submit 100 '--array=1-8 --ntasks=1' '' "--out '$here/array'"
over 'an array of 8'
is 'an array of 8: all tasks complete' [ "$(state | sort -u)" = COMPLETED ]
as_one 'an array of 8' array
is 'an array of 8: the first shows progress alone' \
    [ "$(cat "${job}"_*.out | grep -c ' runs, .* done before')" -eq 1 ]

eval "PATH=\$(dirname '$greenbody'):\$PATH ${sweep/PARTICLES/100} --tasks --out '$here/tasks.out'" \
    2>stderr | sed "s|^greenbody|'$greenbody'|" >tasks
submit 100 '--array=1-12 --ntasks=1' "sed -n \"\${SLURM_ARRAY_TASK_ID}p\" tasks | sh #" ''
over 'an array of tasks'
eval "in_patience ${sweep/PARTICLES/100} --collect --out tasks.out" >stdout 2>stderr
as_one 'an array of tasks' tasks.out

for mpi in $(timeout 60 srun --mpi=list 2>&1 | sed -n 's/^[[:space:]]\+\([a-z0-9_]*\)$/\1/p'); do
    submit 100 '--ntasks=2' "srun -n 2 --mpi=$mpi" "--out '$here/srun-$mpi'"
    over "srun --mpi=$mpi"
    is "srun --mpi=$mpi: status 0" [ "$(state)" = COMPLETED ]
    as_one "srun --mpi=$mpi" "srun-$mpi"
done

# --- what ends in the middle ----------------------------------------------------------------
# Larger cells, so that a task is met at work.
has_begun() { # directory
    [ "$(find "$1" -name curve.csv -size +2k 2>/dev/null | wc -l)" -ge 1 ] || job_is_over
}

rm -rf one
eval "in_patience ${sweep/PARTICLES/400} --out one" >stdout 2>stderr
is 'one process, larger cells' [ $? -eq 0 ]

again() { # name, directory: the same command, at most once more
    eval "in_patience ${sweep/PARTICLES/400} --out '$2'" >stdout 2>stderr
    as_one "$1" "$2"
}

submit 400 '--array=1-2 --ntasks=1' '' "--out '$here/cancelled'"
until_true has_begun cancelled
timeout 60 scancel "${job}_1"
over 'a task cancelled'
again 'a task cancelled' cancelled

submit 400 '--ntasks=1 --requeue' '' "--out '$here/requeued'"
until_true has_begun requeued
timeout 60 scontrol requeue "$job" 2>stderr
over 'requeued'
is 'requeued: the second try completes' [ "$(state)" = COMPLETED ]
as_one 'requeued' requeued

# A minute is the least that Slurm knows: cells that no machine presses in that time.
submit 400 '--ntasks=1 --time=0:01' '' "--set numerics.tolerance=1e-9 --out '$here/late'"
over 'a limit of time'
is 'a limit of time: Slurm ended it' [ "$(state)" = TIMEOUT ]
is 'a limit of time: nothing is left running' until_true none_works late
is 'a limit of time: the list says what is missing' grep -q ',missing,$' late/runs.csv

echo "1..$tests"
exit $bad
