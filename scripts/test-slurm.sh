#!/bin/sh
# A sweep as a job array on a real Slurm, all of it on this machine: slurmctld and slurmd without
# authentication, cgroups or accounting, started for this test and stopped with it. The merged table
# must be that of the local run, but for its last two columns, which say how it was computed.
#
# Needs root (slurmd runs jobs as their user) and Debian's slurmctld, slurmd and slurm-client.
# Usage: scripts/test-slurm.sh [PROGRAM]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-${CARGO_TARGET_DIR:-$root/target}/release/righting}
shards=8

for needed in slurmctld slurmd sbatch squeue; do
    command -v "$needed" > /dev/null || {
        echo "test-slurm: $needed is missing: apt-get install slurmctld slurmd slurm-client" >&2
        exit 1
    }
done
[ "$(id -u)" = 0 ] || { echo "test-slurm: only root can start slurmd" >&2; exit 1; }

work=$(mktemp -d)
chmod 755 "$work"
controller= daemon=
stop() {
    for pid in $daemon $controller; do kill "$pid" 2> /dev/null || true; done
    for pid in $daemon $controller; do wait "$pid" 2> /dev/null || true; done
    rm -rf "$work"
}
trap stop EXIT
trap 'exit 1' INT TERM

mkdir "$work/state" "$work/spool"
host=$(hostname -s)
cores=$(nproc)
cat > "$work/slurm.conf" << CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/none
CredType=cred/none
SlurmUser=root
SlurmdUser=root
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
CONF
export SLURM_CONF="$work/slurm.conf"

slurmctld -D > "$work/slurmctld.log" 2>&1 &
controller=$!
slurmd -D > "$work/slurmd.log" 2>&1 &
daemon=$!
tries=0
until [ "$(sinfo -h -o %T 2> /dev/null)" = idle ]; do
    tries=$((tries + 1))
    [ "$tries" -lt 60 ] || {
        echo "test-slurm: the node does not come up" >&2
        tail -n 20 "$work/slurmctld.log" "$work/slurmd.log" >&2
        exit 1
    }
    sleep 1
done

cat > "$work/sweep.json" << SWEEP
{ "name": "array",
  "scenario": "$root/scenarios/slew_2dof.json",
  "vary": [ { "field": "horizon.steps", "values": [60] },
            { "field": "maneuver.axis", "fibonacci": 8 },
            { "field": "maneuver.angle_deg", "grid": { "from": 5, "to": 25, "count": 5 } } ] }
SWEEP
"$program" sweep "$work/sweep.json" --out "$work/local"
"$program" sweep plan "$work/sweep.json" --out "$work/cluster"
"$program" sweep slurm "$work/cluster" --shards "$shards" --memory 0 --time 10
id=$(sbatch --parsable "$work/cluster/sweep.sbatch")
echo "submitted job array $id"
while [ -n "$(squeue -h -j "$id" 2> /dev/null)" ]; do sleep 1; done
cat "$work"/cluster/logs/*.log
[ "$(ls "$work/cluster/records" | wc -l)" = "$shards" ] || {
    echo "test-slurm: not every shard has records" >&2
    exit 1
}
"$program" sweep merge "$work/cluster" > /dev/null
for run in local cluster; do
    sed 's/,[^,]*,[^,]*$//' "$work/$run/results.csv" > "$work/$run.csv"
done
cmp "$work/local.csv" "$work/cluster.csv"
echo "the job array of $shards shards gives the table of the local run: $(($(wc -l < "$work/local.csv") - 1)) cases"
