# Sourced by the scripts beside it: the sources of the exact core and of what asks it, same_bytes.cpp.
#
# core_sources SOURCE_DIR BUILD_DIR     writes a file that joins most of them, for they share their headers, and prints
# the paths of all that is to be compiled
# core_includes SOURCE_DIR     prints the flags that find its headers
core_includes() {
    for folder in "$1" "$1/src" "$1"/src/*/include; do printf ' -I%s' "$folder"; done
}
core_sources() {
    for name in base/exact_environment base/numbers base/text environment exact_weights \
        inverse predicates quotient weight_signs; do
        echo "#include \"core/$name.cpp\""
    done >"$2/joined.cpp"
    core=$1/src/core
    echo "$2/joined.cpp $core/weights.cpp $core/lanes.cpp $core/field_lanes.cpp $1/tests/core/same_bytes.cpp"
}
