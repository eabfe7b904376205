#!/usr/bin/env bash
# Tries sweep.sbatch for real: a Slurm cluster of three nodes on this host, on the loopback, an array of
# four tasks of which one is killed and queued again, the shards merged, and the map compared with that of
# a single run. Needs Debian's slurmctld, slurmd, slurm-client and munge, root, and the path of a topple:
#
#   docs/slurm/try.sh target/release/topple
set -euo pipefail
topple="$(realpath "${1:?give the path of topple}")"
here="$(cd "$(dirname "$0")" && pwd)"
dir="$(mktemp -d)"
started=()
finish() {
    for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait || true
    rm -rf "$dir"
}
trap finish EXIT

# Munge with a key and a socket of its own.
mkdir -m 755 "$dir/munge"
dd if=/dev/urandom of="$dir/munge/key" bs=128 count=1 status=none
chmod 400 "$dir/munge/key"
chmod 755 "$dir"
munged --foreground --force --key-file "$dir/munge/key" --socket "$dir/munge/socket" \
    --pid-file "$dir/munge/pid" --log-file "$dir/munge/log" --seed-file "$dir/munge/seed" 2>"$dir/munge/said" &
started+=($!)
until [ -S "$dir/munge/socket" ]; do sleep 0.1; done

host="$(hostname -s)"
mkdir "$dir/state"
export SLURM_CONF="$dir/slurm.conf"
# A task that is queued again waits until its credential is void: five seconds here.
cat >"$SLURM_CONF" <<CONF
ClusterName=try
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=17000
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$dir/munge/socket,cred_expire=5
SlurmUser=root
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool-%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd-%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=n[1-3] NodeHostname=$host NodeAddr=127.0.0.1 Port=[17001-17003] CPUs=1
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -D 2>"$dir/slurmctld.said" &
started+=($!)
for node in n1 n2 n3; do
    slurmd -D -N "$node" 2>"$dir/$node.said" &
    started+=($!)
done
until [ "$(sinfo --noheader --format=%D --states=idle 2>/dev/null)" = 3 ]; do sleep 0.5; done
sinfo --format='%10N %.6D %.8T %.5c'

cd "$dir"
map=(pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --omega 1:12:100 --a-h 1:12:100
    --backend reference)
job="$(TOPPLE="$topple" sbatch --parsable --array=1-4 "$here/sweep.sbatch" "${map[@]}")"
# The second task is killed as soon as it has left something to go on from.
until [ -d topple-shards/part-2-of-4/status/c ]; do sleep 0.1; done
squeue --format='%8i %.10T %.6N %.8M'
scontrol requeue "${job}_2"
echo "killed and queued again: task 2"
until [ -z "$(squeue --noheader)" ]; do sleep 0.5; done
for shard in 1 2 3 4; do tail -n 99 "topple-${job}_$shard.log" | grep -E '^(shard|resumed|sweep)'; done
"$topple" merge topple-shards --out merged
"$topple" "${map[@]}" --out single --quiet
for file in map.csv map.npz map.png map.svg; do
    cmp "merged/$file" "single/$file"
    echo "$file is the same"
done
