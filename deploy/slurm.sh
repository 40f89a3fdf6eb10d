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
mkdir -p "$folder"
# As many parts as the records in the folder say, so that lost ones run again alone (sbatch --array=17 with the
# same words); of an empty folder the array has them all.
k=$SLURM_ARRAY_TASK_ID
n=$(find "$folder" -maxdepth 1 -name '*-of-*.json' | sed -n 's|.*/[0-9]*-of-\([0-9]*\)\.json$|\1|p' | sort -u)
count=$SLURM_ARRAY_TASK_COUNT
if ((SLURM_ARRAY_TASK_MIN == 0 && SLURM_ARRAY_TASK_MAX == count - 1)) && ((count > 1 || ${n:-1} == 1)); then
    # A whole array is not a part of another run.
    n=${n:-$count}
    [[ $n == "$count" ]] || n=none
fi
if ! [[ $n =~ ^[0-9]+$ ]] || ((k >= n)); then
    echo "the array must be 0-N, each index once, or parts of the one run whose records are in $folder" >&2
    exit 2
fi

exec hairline audit "$@" --shard "$k/$n" --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet \
    --format json -o "$folder/$k-of-$n.json"
