#!/bin/bash
#SBATCH --job-name=kinetix_collect
#SBATCH --cpus-per-task=1

# sbatch --dependency=afterany:JOB collect.sh DOE.yaml DIR: completes the sweep of the array JOB. Reads the results of
# its tasks, computes the missing ones, and writes samples.csv and the report.
exec "${KINETIX_OPT:-kinetix-opt}" sweep "$1" -o "$2" --resume --quiet --threads "${SLURM_CPUS_PER_TASK:-1}"
