#!/bin/bash

# try_on_one_machine.sh KINETIX_OPT FOLDER: runs ranks.sh, array.sh and collect.sh under a separate Slurm on this
# machine. It kills a rank, a task and the controller during the runs, and compares every table with that of a plain
# run. Run it as root, with the Debian packages slurm-wlm and munge. It leaves nothing running, reports its findings,
# and exits with 1 if a table differs.
set -u
here=$(dirname "$(realpath "$0")")
export KINETIX_OPT=$(realpath "$1")
mkdir -p "$2" && cd "$2" || exit 2
source "$here/one_machine.sh" "$PWD/slurm"
faults=0

cat > strip.yaml <<END
kinetix: 1
structure: {cells: [40, 1], cell_mm: 8}
design: {theta_deg: 20}
END
cat > doe.yaml <<END
kinetix: 1
name: strip
base: strip.yaml
model: equilibrium
method: {kind: lhs, samples: 3000}
factors:
  - {path: design.theta_deg, range: [5, 40]}
responses: [end_mm, turn_deg]
END

# process_of WORDS NAME=VALUE: prints the process of a sweep with these words in its command line and this variable in
# its environment.
process_of() {
  local pid
  for pid in $(pgrep -f -- "$1"); do
    tr '\0' '\n' < "/proc/$pid/environ" 2>/dev/null | grep -qx "$2" && [ "$(cat "/proc/$pid/comm")" = "$(basename "$KINETIX_OPT")" ] && echo "$pid" && return
  done
  return 1
}
# kill_once_it_works WORDS NAME=VALUE TABLE: kills this process as soon as rows of its table are on the disk.
kill_once_it_works() {
  local pid
  for _ in $(seq 600); do
    if [ "$(stat -c %s "$3-wal" 2>/dev/null || echo 0)" -gt 100000 ] && pid=$(process_of "$1" "$2"); then
      kill -9 "$pid" && return
    fi
    sleep 0.02
  done
  echo "  found nothing to kill: $1 $2"
}
# compare NAME FOLDER: compares the table of FOLDER with that of the plain run.
compare() {
  if cmp -s plain/samples.csv "$2/samples.csv"; then echo "$1: the table of the plain run, byte for byte"; return; fi
  echo "$1: ANOTHER TABLE"
  faults=1
}
# wait_for JOB: waits until no part of the job is in the queue.
wait_for() {
  for _ in $(seq 1200); do
    [ -z "$(squeue -h -j "$1" 2>/dev/null)" ] && squeue -h >/dev/null 2>&1 && return
    sleep 0.1
  done
  echo "  job $1 does not end"
}
submit() { sbatch --parsable --output="$PWD/%x-%j.log" "$@"; }
said() { sed -n 's/^  \(samples\|resumed\|run\) /    \1 /p' "$1"; }

rm -rf plain ranks killed_rank shares lost_controller ./*.log
"$KINETIX_OPT" sweep doe.yaml -o plain --quiet >/dev/null || exit 1
start_slurm || { stop_slurm; exit 1; }
trap stop_slurm EXIT
echo "$(srun --version), $(mpirun --version | head -1)"

job=$(submit --ntasks=4 "$here/ranks.sh" doe.yaml ranks) && wait_for "$job"
said kinetix_ranks-"$job".log
compare "four ranks by srun --mpi=pmix" ranks

job=$(submit --ntasks=4 "$here/ranks.sh" doe.yaml killed_rank)
kill_once_it_works "-o killed_rank" PMIX_RANK=2 killed_rank/sweep.sqlite
wait_for "$job"
grep -E "srun: error" kinetix_ranks-"$job".log | sed 's/^/    /'
said kinetix_ranks-"$job".log
compare "a rank killed on the way" killed_rank

job=$(submit --array=1-4 "$here/array.sh" doe.yaml shares)
collect=$(submit --dependency=afterany:"$job" "$here/collect.sh" doe.yaml shares)
kill_once_it_works "-o shares" SLURM_ARRAY_TASK_ID=2 shares/share-2-of-4/sweep.sqlite
wait_for "$job" && wait_for "$collect"
said kinetix_collect-"$collect".log
compare "an array job, one of its tasks killed" shares

job=$(submit --array=1-4 "$here/array.sh" doe.yaml lost_controller)
collect=$(submit --dependency=afterany:"$job" "$here/collect.sh" doe.yaml lost_controller)
for _ in $(seq 600); do [ -e lost_controller/share-1-of-4/sweep.sqlite ] && break; sleep 0.02; done
sleep 6 # the controller saves its list of started jobs after a few seconds
kill -9 "$(cat "$slurm_folder/slurmctld.pid")" && echo "    the controller is killed, and started again after 5 s"
sleep 5
start_controller
wait_for "$job" && wait_for "$collect"
said kinetix_collect-"$collect".log
compare "an array job whose controller was killed" lost_controller
exit $faults
