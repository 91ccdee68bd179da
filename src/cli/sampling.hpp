/// What `barycert sample` and `barycert resample` share: options, the order of the work, the report.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace barycert::cli {

/// Whether the mesh is checked first, so that points can be found by walks.
enum class Certify : std::uint8_t { automatic, always, never };

/// NAME=FILE, and what its rows are for.
struct FieldFile {
    enum class Of : std::uint8_t { either, points, cells };
    Of of = Of::either;
    std::string name, path;
};

/// The options that both have.
struct SamplingArguments {
    std::string mesh, output, json;
    std::vector<FieldFile> field_files;
    std::vector<std::string> fields;  ///< as given; empty: all
    SampleOptions options;
    Certify certify = Certify::automatic;
    bool quiet = false;
};

void add_sampling_options(CLI::App& sub, SamplingArguments& arguments);

/// Seconds since it was made or last asked.
class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> time = now - last_;
        last_ = now;
        return time.count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// True if there is to be progress for that run.
bool wants_progress(const SamplingArguments& arguments);

/// Writes the JSON where it is asked for and the summary where there is room for it: on stdout, or, where that has rows
/// or the JSON, on stderr.
Status write_reports(const SamplingArguments& arguments, const SampleRun& run);

/// The run as far as the arguments tell.
SampleRun run_of(const std::string& command, const SamplingArguments& arguments);

/// Limits all threads of the process to the number asked for, while it lives.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Control;
    std::unique_ptr<Control> control_;
};

}  // namespace barycert::cli
