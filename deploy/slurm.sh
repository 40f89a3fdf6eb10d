#!/usr/bin/env bash
# A run in parts on Slurm: one task of a job array is one shard. Every task may be killed and requeued:
# its record appears whole or not at all.
#
#   sbatch --array=0-63 deploy/slurm.sh OUT -n 100_000_000 --kernel woop-watertight
#   hairline merge OUT/*.json --format json -o merged.json
#
# The first argument is a folder that all nodes see; the others go to `hairline audit`.
#SBATCH --job-name=hairline
#SBATCH --requeue
#SBATCH --ntasks=1
set -euo pipefail

folder=$1
shift
# Passed on explicitly: the number of tasks is that of the array, and the first index is 0.
k=$SLURM_ARRAY_TASK_ID
n=$SLURM_ARRAY_TASK_COUNT
if ((SLURM_ARRAY_TASK_MIN != 0 || SLURM_ARRAY_TASK_MAX != n - 1)); then
    echo "the array must be 0-$((n - 1)), each index once" >&2
    exit 2
fi

mkdir -p "$folder"
exec hairline audit "$@" --shard "$k/$n" --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet \
    --format json -o "$folder/$k-of-$n.json"
