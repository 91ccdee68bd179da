#!/bin/sh
# libraries_test.sh BARYCERT FOLDER: the kernels that ask Python answer, and answer what the packages say. They keep a
# process of their own, which kernels in a process of theirs may not. Those whose package
# no python3 has are passed over; exits with 77 if that is all.
barycert=$1
folder=$2
failed=0
asked=0

has() {
    for python in python3 /usr/bin/python3; do "$python" -c "import $1" 2>/dev/null && return; done
    return 1
}

# clean LIBRARY FAMILY: no finding at all.
clean() {
    if ! "$barycert" audit --kernel-library "$folder/$1.so" --in-process --family "$2" --count 300 --fail-on any --quiet; then
        echo "$1: wrong in $2"
        failed=1
    fi
    asked=1
}

# says LIBRARY FAMILY TEXT: the report has it.
says() {
    "$barycert" audit --kernel-library "$folder/$1.so" --in-process --family "$2" --count 300 | grep -q "$3" || {
        echo "$1: not in the report of $2: $3"
        failed=1
    }
}

if has scipy.spatial; then
    for simplex in triangle tetrahedron; do
        # Points well inside; cells that Qhull refuses because they are flat.
        clean scipy-$simplex mesh.inside
        clean scipy-$simplex degenerate.point
        # It refuses these as well, which are not flat.
        says scipy-$simplex tiny 'wrong in 100 % of 300 cases'
        says scipy-$simplex mesh.inside "scipy.spatial.Delaunay.transform"
    done
fi
if has matplotlib.tri; then
    clean matplotlib-triangle mesh.inside
    # A flat triangle has a plane all the same, a pseudo-inverse.
    says matplotlib-triangle degenerate.line 'wrong in [1-9]'
fi
[ $asked = 1 ] || { echo "no python3 has SciPy or matplotlib"; exit 77; }
exit $failed
