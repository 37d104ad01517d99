#!/bin/bash
#SBATCH --job-name=kinetix_array
#SBATCH --array=1-8
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append

# sbatch array.sh DOE.yaml DIR: a sweep in one share per task of the array. The tasks are independent. collect.sh
# computes the rest of a failed one.
exec "${KINETIX_OPT:-kinetix-opt}" sweep "$1" -o "$2" --share "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --resume --quiet \
  --threads "${SLURM_CPUS_PER_TASK:-1}"
