#!/bin/bash
#SBATCH --job-name=kinetix_ranks
#SBATCH --ntasks=16
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append

# sbatch ranks.sh DOE.yaml DIR: a sweep by ranks of MPI, one table. A rank that fails ends the step, by MPI's rules.
# Its results are on the disk, and the next attempt computes the rest on all ranks. Slurm restarts the job after
# losing a node.
for attempt in 1 2 3; do
  srun --mpi=pmix "${KINETIX_OPT:-kinetix-opt}" sweep "$1" -o "$2" --resume --quiet && exit
  code=$?
  [ $code = 2 ] && break # bad input: another attempt would not help
done
exit $code
