#!/bin/sh
# A fleet on a real Slurm and under a real mpirun gives what one run gives:
#
#   slurm_test.sh ERRMAP
#
# Starts munged, slurmctld and slurmd in a folder of its own, one node of two
# processors, without systemd, and ends them. Exit status 77 where they are not
# installed or may not be started.
set -eu

errmap=$1
PATH=$PATH:/usr/sbin

for tool in munged slurmctld slurmd sbatch squeue mpirun gzip sqlite3; do
  if ! command -v "$tool" >/dev/null 2>&1; then
    echo "slurm: skipped, no $tool: apt-get install slurm-wlm munge openmpi-bin sqlite3"
    exit 77
  fi
done
if [ "$(id -u)" -ne 0 ]; then
  echo "slurm: skipped, only root can start it here"
  exit 77
fi

scratch=$(mktemp -d)
daemons=""
end() {
  for daemon in $daemons; do kill "$daemon" 2>/dev/null || true; done
  sleep 1
  for daemon in $daemons; do kill -KILL "$daemon" 2>/dev/null || true; done
  rm -rf "$scratch"
}
trap end EXIT
cd "$scratch"
failed=0
complain() {
  echo "slurm: $*" >&2
  failed=1
}

# ---- A fleet: two machines, a broken component

mkdir -p data/m01 data/m02
for machine in m01 m02; do
  for file in x_down x_up z_down; do
    awk -v "seed=$machine$file" 'BEGIN {
      for (i = 1; i <= length(seed); ++i)
        state = (state * 31 + index("mxzdownup_012", substr(seed, i, 1))) % 65521
      print "day,cycle,position_mm,t1_degC,error_mm"
      for (day = 1; day <= 4; ++day) for (c = 1; c <= 3; ++c)
        for (i = 0; i < 6; ++i) {
          state = (state * 1103 + 12345) % 65521
          t = 20 + c + 0.3 * day
          printf "%d,%d,%d,%.4f,%.6f\n", day, 3 * day + c, 50 * i, t,
            1e-5 * 50 * i + 0.002 * (t - 20) + 0.0005 * state / 65521
        }
    }' >"data/$machine/$file.csv"
  done
done
echo "position_mm,error_mm" >data/m02/yaw_up.csv
cat >fleet.toml <<'END'
models = ["mean", "poly:position", "poly:full:degree=1"]
[[component]]
name = "{machine}/{component}"
data = "data/{machine}/{component}_{direction}.csv"
END

# contents STORE: its tables and full results, times apart.
contents() {
  for sql in \
    "SELECT * FROM runs" \
    "SELECT name, study, status, why, folder, data, sha256, rows, sessions, target,
       unit, goal FROM components" \
    "SELECT * FROM fields" "SELECT * FROM holdouts" \
    "SELECT component, model, kind, choice, status, why, parameters FROM models" \
    "SELECT * FROM metrics" "SELECT * FROM verdicts" \
    "SELECT * FROM recommendations" "SELECT * FROM sensors" "SELECT * FROM maps"; do
    sqlite3 -csv -header "$1/errmap.sqlite" "$sql"
  done
  find "$1/components" -name results.json.gz | sort | while read -r file; do
    gzip -dc "$file" | tr ',{' '\n\n' | grep -v -e seconds -e _ns
  done
}

"$errmap" compare --config fleet.toml --out whole --quiet >/dev/null
contents whole >whole.txt

# ---- mpirun

OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  mpirun -n 2 --oversubscribe "$errmap" compare --config fleet.toml --out mpi \
  --shard env --quiet || complain "mpirun failed"
"$errmap" merge mpi >/dev/null || complain "something is missing after mpirun"
contents mpi >mpi.txt
cmp whole.txt mpi.txt || complain "mpirun gave other contents"

# ---- Slurm

host=$(hostname -s)
mkdir state spool
cat >slurm.conf <<END
ClusterName=errmap
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge.sock
CredType=cred/munge
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/ctld.pid
SlurmdPidFile=$scratch/d.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,bf_interval=2
ReturnToService=2
SwitchType=switch/none
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1500
PartitionName=main Nodes=ALL Default=YES State=UP
END
export SLURM_CONF="$scratch/slurm.conf"
chmod 755 "$scratch"
dd if=/dev/urandom of=munge.key bs=1024 count=1 2>/dev/null
chmod 600 munge.key
munged --foreground --force --key-file "$scratch/munge.key" \
  --socket "$scratch/munge.sock" --pid-file "$scratch/munge.pid" \
  --log-file "$scratch/munge.log" --seed-file "$scratch/munge.seed" \
  >munged.out 2>&1 &
daemons="$!"
sleep 1
slurmctld -D -f "$SLURM_CONF" >ctld.log 2>&1 &
daemons="$! $daemons"
slurmd -D -f "$SLURM_CONF" -N "$host" >d.log 2>&1 &
daemons="$! $daemons"

# wait_for SECONDS COMMAND: until it succeeds.
wait_for() {
  left=$1
  shift
  while [ "$left" -gt 0 ]; do
    if "$@" >/dev/null 2>&1; then return 0; fi
    sleep 1
    left=$((left - 1))
  done
  return 1
}
node_is_idle() { sinfo -h -o %t | grep -qx idle; }
no_jobs() { jobs=$(squeue -h) && [ -z "$jobs" ]; }

if ! wait_for 90 node_is_idle; then
  tail -n 3 munged.out ctld.log d.log >&2
  echo "slurm: skipped, it does not start on this machine"
  exit 77
fi
"$errmap" submit slurm --config fleet.toml --out array --tasks 8 --now ||
  complain "submit failed"
grep -q 'array=0-7' array/slurm/shards.sh || complain "no array of 8"
grep -q 'afterany' array/slurm/submit.sh || complain "the merge is not behind it"
if ! wait_for 300 no_jobs; then complain "jobs are left: $(squeue -h)"; fi
if [ ! -f array/errmap.sqlite ]; then
  complain "nothing was merged"
  tail -n 5 array/slurm/*.log >&2
else
  contents array >array.txt
  cmp whole.txt array.txt || complain "the job array gave other contents"
fi
# A task that goes on finds everything done.
"$errmap" compare --config fleet.toml --out array --shard 3/8 2>&1 |
  grep -q ' 0 fitted' || complain "a share was done twice"
if [ "$failed" -eq 0 ]; then
  echo "slurm: mpirun -n 2 and an array of 8 agree with one run"
fi
exit "$failed"
