#!/bin/sh
# A batch as an array job of Slurm: a task for each part, in any order, on any machine that sees the
# files. Rows of one part are solved by the threads of its task.
#
#   array=$(sbatch --parsable --array=1-8 batch_array.sh CASES.csv RESULTS.csv)
#   sbatch --dependency=afterany:$array batch_array.sh CASES.csv RESULTS.csv
#
# The second job is no array: it joins the parts, and refuses if one is missing. A task that was
# ended and queued again goes on where it was. Where there is no Slurm, a loop does the same:
#
#   for k in 1 2 3; do
#       SLURM_ARRAY_TASK_ID=$k SLURM_ARRAY_TASK_COUNT=3 sh batch_array.sh CASES.csv RESULTS.csv
#   done
#   sh batch_array.sh CASES.csv RESULTS.csv
#SBATCH --job-name=faststrip
#SBATCH --cpus-per-task=8
#SBATCH --requeue
set -eu
cases=${1:?the cases, CASES.csv} results=${2:?the results, RESULTS.csv}
task=${SLURM_ARRAY_TASK_ID-}
if [ -n "$task" ]; then
    exec faststrip batch "$cases" --part "$task/$SLURM_ARRAY_TASK_COUNT" --resume --quiet \
        --threads "${SLURM_CPUS_PER_TASK:-1}" -o "$results.part_$task.csv"
fi
exec faststrip merge "$results".part_*.csv -o "$results"
