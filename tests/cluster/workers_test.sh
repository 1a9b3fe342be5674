#!/usr/bin/env bash
# workers_test.sh slurm|parallel WALKTRACK SOURCE_DIR
# Two workers of a scheduler end with the summary and the results of one local batch. Exit code 77,
# "skipped", where the scheduler is not installed or cannot run.
set -euo pipefail
scheduler=$1 walktrack=$2 source_dir=$3
work=$(mktemp -d)
daemons=()
finish() {
  for pid_file in "${daemons[@]}"; do
    [ -s "$pid_file" ] && kill "$(cat "$pid_file")" 2>/dev/null
  done
  sleep 1
  rm -rf "$work"
}
trap finish EXIT

skip() {
  echo "SKIPPED: $1"
  exit 77
}

start_slurm() {
  for program in munged slurmctld slurmd sbatch; do
    command -v "$program" >/dev/null || skip "$program is not installed"
  done
  [ "$(id -u)" -eq 0 ] || skip "Slurm on one node needs root"
  local s=$work/slurm
  mkdir -p "$s/state" "$s/spool"
  chmod 755 "$work" "$s"
  dd if=/dev/urandom of="$s/munge.key" bs=1024 count=1 2>/dev/null
  chmod 600 "$s/munge.key"
  munged --key-file="$s/munge.key" --socket="$s/munge.socket" --pid-file="$s/munged.pid" \
    --log-file="$s/munged.log" --seed-file="$s/munge.seed" --force >/dev/null 2>&1 ||
    skip "munged does not start"
  daemons+=("$s/munged.pid")
  cat >"$s/slurm.conf" <<END
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$s/munge.socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=defer,batch_sched_delay=0,sched_interval=1
ReturnToService=2
SlurmctldPort=16817
SlurmdPort=16818
SlurmctldPidFile=$s/slurmctld.pid
SlurmdPidFile=$s/slurmd.pid
SlurmctldLogFile=$s/slurmctld.log
SlurmdLogFile=$s/slurmd.log
StateSaveLocation=$s/state
SlurmdSpoolDir=$s/spool
NodeName=localhost NodeAddr=127.0.0.1 NodeHostname=$(hostname) CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES State=UP
END
  export SLURM_CONF=$s/slurm.conf
  slurmctld -c || skip "slurmctld does not start"
  daemons+=("$s/slurmctld.pid")
  slurmd -N localhost || skip "slurmd does not start"
  daemons+=("$s/slurmd.pid")
  for _ in $(seq 60); do
    [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && return
    sleep 1
  done
  skip "the node does not become idle"
}

wait_for_job() {
  while squeue -h -j "$1" 2>/dev/null | grep -q .; do sleep 0.5; done
}

# The summary without the times.
summary_of() { cut -d, -f1,2,4- "$1/summary.csv"; }

make_sequences() {
  cat >"$work/walk.yaml" <<END
frame_rate: 15
duration: 0.8
initial: true
background_frames: 5
walk: {speed: 1.2, start: [-0.5, 0]}
cameras: [{name: side, azimuth_deg: -90, distance: 4, size: [96, 72]}]
END
  "$walktrack" render --options "$work/walk.yaml" -o "$work/walk"
  for name in "first one" second third fourth fifth broken; do
    mkdir -p "$work/in"
    cp -r "$work/walk" "$work/in/$name"
  done
  echo "no video" >"$work/in/broken/side.mp4"
}

[ "$scheduler" = parallel ] && { command -v parallel >/dev/null || skip "parallel is not installed"; }
[ "$scheduler" = slurm ] && start_slurm
make_sequences
options=(--threads 1 --set filter.particles=20 -c "$source_dir/tests/any_quality.yaml")
"$walktrack" batch "$work/in" -o "$work/local" --quiet "${options[@]}" || [ $? -eq 1 ]
export WALKTRACK=$walktrack
if [ "$scheduler" = slurm ]; then
  job=$("$source_dir/scripts/cluster/slurm.sh" "$work/in" "$work/out" 2 "${options[@]}")
  wait_for_job "$job"
else
  "$source_dir/scripts/cluster/parallel.sh" "$work/in" "$work/out" 2 "${options[@]}" || [ $? -eq 1 ]
fi

diff <(summary_of "$work/local") <(summary_of "$work/out")
[ "$(grep -c ,complete, "$work/out/summary.csv")" -eq 5 ]
for name in "first one" second third fourth fifth; do
  cmp "$work/local/$name/joints.csv" "$work/out/$name/joints.csv"
done
echo "two workers of $scheduler: the same summary and results as one local batch"
