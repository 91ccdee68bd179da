/// Series: files that name the files of steps (.pvd, .vtu.series), and which step is meant.
///
/// Example:
///
///     #include <cstdio>
///     for (const SeriesStep& step : read_series("run.pvd").value()) std::printf("%g %s\n", step.time,
///     step.files[0].c_str()); const StepChoice choice{.last = true};
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

/// Which step of a series (.pvd, .vtu.series) is meant: at most one of these. None: the first.
struct StepChoice {
    std::optional<std::size_t> number = {};  ///< from 0, in the order of the file
    std::optional<double> time = {};         ///< exactly as the file has it
    bool last = false;

    bool made() const { return number || time || last; }
};

/// A step of a series: files that make one data set.
struct SeriesStep {
    double time = 0;
    std::vector<std::string> files;  ///< as they can be opened
};

/// The steps of a series in the order of the file. In a .pvd file entries of one time that follow each other are one
/// step. Error: no such file; no series; an entry without a file; a time not finite, or in a .series file not its own.
Result<std::vector<SeriesStep>> read_series(const std::string& path);

}  // namespace barycert
