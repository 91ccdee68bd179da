/// Formulas under sets of compiler flags, each answer held against the strict build's and the exact one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::flags {

/// A set of flags: a column of the matrix.
struct Variant {
    std::string compiler, label, flags, library;
    bool flush = false;  ///< the library is run with subnormal operands and results flushed to zero
};

/// Results of a formula under one set of flags.
struct Cell {
    bool ran = false;
    std::uint64_t cases = 0;
    std::uint64_t changed = 0;      ///< answers other than the strict build's by a bit or more
    std::uint64_t wrong = 0;        ///< answers with a wrong sign, zero, region or declaration, or not finite
    std::uint64_t newly_wrong = 0;  ///< of these, those that the strict build has right
    std::uint64_t newly_right = 0;  ///< wrong in the strict build, and right here
    double worst_change = 0;        ///< largest |weight - strict weight| / max |exact weight|, both finite
};

struct Row {
    std::string kernel;
    std::vector<Cell> cells;  ///< one a column; the first is the strict build
};

struct Matrix {
    std::uint64_t seed = 1, count = 0;
    std::vector<Variant> columns;  ///< the first is gcc's strict build, or clang's where there is no gcc
    std::vector<Row> rows;
    std::vector<std::string> families;
    std::vector<std::string> compilers;  ///< by name and version
};

/// Reads the list that the build made and loads the libraries. `count`: cases of each family that needs no mesh.
/// Columns that this processor cannot run (FMA) are left out. Errors: a library cannot be loaded.
Result<Matrix> measure(const std::string& list, std::uint64_t count, std::uint64_t seed);

/// Two tables for a document: answers that change, answers that get wrong; in per cent.
std::string markdown(const Matrix& matrix);
std::string json(const Matrix& matrix);

/// Rows and columns of squares: the darker the more answers change; a ring where some get wrong that were right, the
/// larger the more.
std::string picture(const Matrix& matrix);

}  // namespace barycert::flags
