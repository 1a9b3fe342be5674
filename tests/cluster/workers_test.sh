#!/usr/bin/env bash
# workers_test.sh slurm|parallel|snakemake WALKTRACK SOURCE_DIR [SEQUENCES]
# Two workers of a scheduler on one machine end with the results of one local batch, each sequence done
# once. Exit code 77, "skipped", where the scheduler is not installed or cannot run.
set -euo pipefail
scheduler=$1 walktrack=$2 source_dir=$3 sequences=${4:-6}
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

# State, digest and reason of the sequences that the local batch has, without times.
summary_of() { grep -F -f "$work/named" "$1/summary.csv" | cut -d, -f1,2,4,5 | sort; }

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
  printf '%s\n' "first one" second third fourth fifth broken >"$work/named"
  seq -f 'more/%g' 1 $((sequences - 6)) | cat "$work/named" - >"$work/names"
  while IFS= read -r name; do
    mkdir -p "$(dirname "$work/in/$name")"
    cp -r "$work/walk" "$work/in/$name"
    printf 'in/%s/scene.yaml\t%s\n' "$name" "$name" >>"$work/manifest.txt"
  done <"$work/names"
  echo "no video" >"$work/in/broken/side.mp4"
}

for program in parallel snakemake; do
  [ "$scheduler" != "$program" ] || command -v "$program" >/dev/null || skip "$program is not installed"
done
[ "$scheduler" = slurm ] && start_slurm
make_sequences
options=(--set filter.particles=20 -c "$source_dir/tests/any_quality.yaml")
head -6 "$work/manifest.txt" | (cd "$work" && "$walktrack" batch --manifest - -o local --quiet --threads 1 "${options[@]}") ||
  [ $? -eq 1 ]
export WALKTRACK=$walktrack
case $scheduler in
slurm)
  job=$("$source_dir/scripts/cluster/slurm.sh" "$work/in" "$work/out" 2 "${options[@]}")
  wait_for_job "$job"
  ;;
parallel)
  "$source_dir/scripts/cluster/parallel.sh" "$work/manifest.txt" "$work/out" 2 --threads 1 "${options[@]}" || [ $? -eq 1 ]
  ;;
snakemake)
  mkdir "$work/snakemake"
  ! snakemake -s "$source_dir/scripts/cluster/Snakefile" -d "$work/snakemake" -j 2 --quiet --config folder="$work/in" \
    out="$work/out" workers=2 walktrack="$walktrack" options="${options[*]} --work $work/local_disk" >"$work/log" 2>&1 ||
    { echo "snakemake does not say that a sequence failed"; exit 1; }
  ;;
esac

diff <(summary_of "$work/local") <(summary_of "$work/out")
[ "$(grep -c ,complete, "$work/out/summary.csv")" -eq $((sequences - 1)) ]
grep -v broken "$work/names" | while IFS= read -r name; do
  cmp "$work/local/second/joints.csv" "$work/out/$name/joints.csv"
  # The CPUs of a task are shared out, not the node's.
  grep -q '"threads": 1,' "$work/out/$name/run.json"
done
[ -z "$(find "$work/out" -name '.walktrack_for*')" ]
echo "two workers of $scheduler: the results of one local batch, $sequences sequences"
