#!/bin/sh
# Makes halves.msh again, with Gmsh 4.8.4: data/gmsh/make.sh. T is 1 + 2x + 4y + 8z at each node.
set -eu
cd "$(dirname "$0")"
gmsh -3 halves.geo -nt 1 -format msh41 -o halves.msh
awk '
    /^\$Nodes/ { inside = 1; getline; next }
    /^\$EndNodes/ { inside = 0 }
    inside && left == 0 { left = $4; count = 0; next }
    inside && NF == 1 { tag[count++] = $1; next }
    inside { left--; t[++nodes] = tag[count - left - 1] " " 1 + 2 * $1 + 4 * $2 + 8 * $3 }
    END {
        print "$NodeData\n1\n\"T\"\n1\n0\n3\n0\n1\n" nodes
        for (i = 1; i <= nodes; ++i) print t[i]
        print "$EndNodeData"
    }' OFMT=%.17g CONVFMT=%.17g halves.msh >halves.data
cat halves.data >>halves.msh
rm halves.data
