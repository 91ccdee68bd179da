#include "files.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "barycert/base/output_file.hpp"
#include "options.hpp"

namespace barycert::cli {
namespace {

CLI::Validator not_empty() {
    return {[](std::string& text) { return text.empty() ? "expected the name of a file, found \"\"" : ""; }, ""};
}

}  // namespace

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::string& path, const std::string& help) {
    return sub.add_option(name, path, help)->check(not_empty())->type_name("FILE");
}

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::vector<std::string>& paths,
                         const std::string& help) {
    return sub.add_option(name, paths, help)->check(not_empty())->type_name("FILE")->allow_extra_args(false);
}

void step_options(CLI::App& sub, StepChoice& step, bool* all) {
    auto* const number =
        sub.add_option_function<std::string>(
               "--step",
               [&step, all](const std::string& text) {
                   if (all != nullptr && text == "all") {
                       *all = true;
                   } else if (text == "last") {
                       step.last = true;
                   } else {
                       std::size_t n = 0;
                       const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), n);
                       if (code != std::errc() || end != text.data() + text.size())
                           refuse_option(
                               "--step",
                               std::string("a number from 0, ") + (all != nullptr ? "all or last" : "or last"), text);
                       step.number = n;
                   }
               },
               std::string("Of a MESH that is a series (.pvd, .vtu.series, .vtp.series): the step to read, by its "
                           "number from 0; "
                           "default: the first") +
                   (all == nullptr ? "" : ", or all where {step} or {time} stands in --output: a file for each"))
            ->type_name(all != nullptr ? "N|all|last" : "N|last");
    sub.add_option_function<std::string>(
           "--time",
           [&step](const std::string& text) {
               step.time = finite(text);
               if (!step.time) refuse_option("--time", "a finite number", text);
           },
           "Likewise, by its time, exactly as the file has it")
        ->excludes(number)
        ->type_name("T");
}

Status write_output(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
            return Error{.what = "cannot write to stdout", .found = std::strerror(errno)};
        return Done{};
    }
    base::OutputFile file(path);
    file.write(bytes);
    return file.commit();
}

Status all_written(const std::vector<Status>& written) {
    const auto wrong = std::find_if(written.begin(), written.end(), [](const Status& status) { return !status; });
    return wrong == written.end() ? Status(Done{}) : *wrong;
}

}  // namespace barycert::cli
