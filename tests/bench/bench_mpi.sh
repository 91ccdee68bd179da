#!/bin/sh
# vtkPBarycertProbe in jobs of 1, 2, 4 and 8 ranks on this machine: bytes, memory, seconds. Each answer is compared with
# that of vtkBarycertProbe on the whole mesh, all bytes of all rows.
#   bench_mpi JOB LAUNCHER NUMPROC_FLAG [POINTS [CUBES]]    see mpi_job.cpp; RANKS="2 4" and CUTS="slabs" take some alone
# Columns: points sent, bytes sent and predicted are means over the ranks; most, gathered and MiB are those of the rank
# that has the most; "before" is memory with the piece and the points, before the probe.
set -eu
job=$1
launcher=$2
flag=$3
points=${4:-1000000}
cubes=${5:-0}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
OMPI_ALLOW_RUN_AS_ROOT=1
OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
OMPI_MCA_rmaps_base_oversubscribe=1
OMPI_MCA_hwloc_base_binding_policy=none
OMPI_MCA_mpi_yield_when_idle=1
export OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe \
    OMPI_MCA_hwloc_base_binding_policy OMPI_MCA_mpi_yield_when_idle
echo "| ranks | mesh | points | points sent | bytes sent | most | predicted | ratio | bytes gathered | MiB | before | s, first | s, again |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
for ranks in ${RANKS:-1 2 4 8}; do
    for cut in ${CUTS:-slabs blocks scattered}; do
        # One rank has one piece; cells anywhere are the worst case.
        case $ranks:$cut in 1:blocks | [124]:scattered) continue ;; esac
        "$job" cut "$folder" "$ranks" "$cut" "$points" "$cubes"
        for where in aligned scattered; do
            case $ranks:$cut:$where in 1:*:scattered | *:scattered:aligned) continue ;; esac
            "$launcher" "$flag" "$ranks" "$job" run "$folder" "$cut" "$where" "$points"
        done
        rm -f "$folder"/*
    done
done
