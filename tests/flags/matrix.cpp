#include "matrix.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "tests/audit/compared_weights.hpp"
#include "variant.hpp"

namespace barycert::flags {
namespace {

/// Subnormal operands and results are zero while it lives.
class FlushToZero {
public:
    explicit FlushToZero(bool on) {
#if defined(__SSE2__)
        before_ = _mm_getcsr();
        if (on) _mm_setcsr(before_ | 0x8040U);
#else
        static_cast<void>(on);
#endif
    }
    ~FlushToZero() {
#if defined(__SSE2__)
        _mm_setcsr(before_);
#endif
    }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;

private:
    unsigned before_ = 0;
};

struct Loaded {
    Variant variant;
    std::vector<FlagsEntry> entries;

    FlagsFunction find(const std::string& name) const {
        for (const FlagsEntry& e : entries) {
            if (e.name == name) return e.weights;
        }
        return nullptr;
    }
};

Result<Loaded> load(const Variant& v) {
    void* const library = dlopen(v.library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        return Error{.code = "file.missing", .what = "cannot load the formulas", .file = v.library, .found = dlerror()};
    const auto entries = reinterpret_cast<decltype(&flags_entries)>(dlsym(library, "flags_entries"));
    if (entries == nullptr)
        return Error{.code = "file.missing", .what = "no formulas in the library", .file = v.library};
    int count = 0;
    const FlagsEntry* const first = entries(&count);
    return Loaded{v, {first, first + count}};
}

bool runs_here(const Variant& v) {
#if defined(__x86_64__)
    if (v.flags.find("-mfma") != std::string::npos && __builtin_cpu_supports("fma") == 0) return false;
    if (v.flags.find("-mavx2") != std::string::npos && __builtin_cpu_supports("avx2") == 0) return false;
#else
    static_cast<void>(v);
#endif
    return true;
}

std::vector<Variant> read_list(const std::string& path) {
    std::ifstream in(path);
    std::vector<Variant> all;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        Variant v;
        if (std::getline(words, v.compiler, '|') && std::getline(words, v.label, '|') &&
            std::getline(words, v.flags, '|') && std::getline(words, v.library, '|') && runs_here(v))
            all.push_back(v);
    }
    // The strict build once more, subnormals flushed: what a library with -ffast-math in it does to everyone.
#if defined(__SSE2__)
    if (!all.empty()) {
        Variant flushed = all.front();
        flushed.label = "-O2, flush-to-zero";
        flushed.flush = true;
        all.push_back(flushed);
    }
#endif
    return all;
}

struct Answer {
    int status = 0;
    std::array<double, 4> weights = kernels::unset_weights;

    /// Not a number is not a number, whatever its bits.
    bool same(const Answer& other, int n) const {
        if (status != 0 || other.status != 0) return status == other.status;
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
            const double x = weights[i], y = other.weights[i];
            if (std::isnan(x) && std::isnan(y)) continue;
            if (std::bit_cast<std::uint64_t>(x) != std::bit_cast<std::uint64_t>(y)) return false;
        }
        return true;
    }
};

Answer answer_of(FlagsFunction f, const Case& c, bool flush) {
    Answer a;
    const FlushToZero environment(flush);
    a.status = f(c.vertices.data(), c.point.data(), a.weights.data());
    return a;
}

double change(const Answer& a, const Answer& strict, const OracleAnswer& exact, int n) {
    if (a.status != 0 || strict.status != 0 || exact.region == Region::degenerate) return 0;
    double max = 0, largest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const double d = std::fabs(a.weights[i] - strict.weights[i]);
        if (!std::isfinite(d)) return 0;
        max = std::max(max, d);
        largest = std::max(largest, std::fabs(exact.weights[i]));
    }
    return max / largest;
}

void add_case(Row& row, const Kernel& kernel, const std::vector<Loaded>& columns,
              const std::vector<FlagsFunction>& functions, const Case& c) {
    const OracleAnswer exact = ask_oracle(c);
    const int n = vertex_count(c.simplex);
    const Answer strict = answer_of(functions[0], c, false);
    const bool strict_wrong = audit::compare(kernel, c, exact, strict.status, strict.weights).wrong();
    for (std::size_t k = 0; k < columns.size(); ++k) {
        Cell& cell = row.cells[k];
        if (functions[k] == nullptr) continue;
        cell.ran = true;
        ++cell.cases;
        const Answer a = answer_of(functions[k], c, columns[k].variant.flush);
        const bool wrong = audit::compare(kernel, c, exact, a.status, a.weights).wrong();
        if (!a.same(strict, n)) ++cell.changed;
        if (wrong) ++cell.wrong;
        if (wrong && !strict_wrong) ++cell.newly_wrong;
        if (!wrong && strict_wrong) ++cell.newly_right;
        cell.worst_change = std::max(cell.worst_change, change(a, strict, exact, n));
    }
}

std::string first_line_of(const std::string& command) {
    std::string line;
    if (FILE* const pipe = ::popen(command.c_str(), "r")) {
        for (int c = std::fgetc(pipe); c != EOF && c != '\n'; c = std::fgetc(pipe)) line += static_cast<char>(c);
        ::pclose(pipe);
    }
    return line;
}

/// In per cent; what is not none, and not all, never looks like it.
std::string share(std::uint64_t part, std::uint64_t whole) {
    if (part == 0) return "0";
    if (part == whole) return "100";
    const double p = 100 * static_cast<double>(part) / static_cast<double>(whole);
    return p < 0.01 ? "<0.01" : fmt::format("{:.{}f}", p, p < 1 ? 2 : p < 10 ? 1 : 0);
}

bool changes(const Matrix& m, std::size_t column) {
    return std::any_of(m.rows.begin(), m.rows.end(), [&](const Row& row) { return row.cells[column].changed != 0; });
}

/// Columns in which nothing changes are left out.
template <class Text>
std::string table(const Matrix& m, Text text) {
    std::string head = "| formula |", rule = "|---|";
    for (std::size_t k = 0; k < m.columns.size(); ++k) {
        if (!changes(m, k)) continue;
        head += fmt::format(" {} `{}` |", m.columns[k].compiler, m.columns[k].label);
        rule += "--:|";
    }
    std::string out = head + "\n" + rule + "\n";
    for (const Row& row : m.rows) {
        out += "| `" + row.kernel + "` |";
        for (std::size_t k = 0; k < m.columns.size(); ++k) {
            if (changes(m, k)) out += " " + (row.cells[k].ran ? text(row.cells[k]) : std::string("-")) + " |";
        }
        out += "\n";
    }
    return out;
}

}  // namespace

Result<Matrix> measure(const std::string& list, std::uint64_t count, std::uint64_t seed) {
    const ExactEnvironment environment;
    Matrix m;
    m.count = count;
    m.seed = seed;
    m.columns = read_list(list);
    std::vector<Loaded> columns;
    for (const Variant& v : m.columns) {
        Result<Loaded> loaded = load(v);
        if (!loaded) return loaded.error();
        columns.push_back(std::move(*loaded));
        ExactEnvironment::renew();
        const std::string version =
            v.compiler + ": " + first_line_of(v.compiler == "gcc" ? "g++ --version" : "clang++ --version");
        if (std::find(m.compilers.begin(), m.compilers.end(), version) == m.compilers.end())
            m.compilers.push_back(version);
    }
    if (columns.empty())
        return Error{.code = "file.missing",
                     .what = "no library of formulas",
                     .file = list,
                     .remedy = "build the target flags_variants"};
    const MeshSource none;
    for (const Family& f : all_families()) {
        if (!f.needs_mesh) m.families.push_back(f.name);
    }
    for (const FlagsEntry& entry : columns[0].entries) {
        Kernel kernel = kernels_matching(entry.name).at(0);
        kernel.certifies = false;
        kernel.interpolate = nullptr;
        Row row{entry.name, std::vector<Cell>(columns.size())};
        std::vector<FlagsFunction> functions;
        for (const Loaded& l : columns) functions.push_back(l.find(entry.name));
        for (const Family& f : all_families()) {
            if (f.needs_mesh || !f.applies_to(kernel.simplex) || f.perspective != kernel.perspective) continue;
            for (std::uint64_t i = 0; i < count; ++i)
                add_case(row, kernel, columns, functions, make_case(f, kernel.simplex, seed, i, none));
        }
        m.rows.push_back(std::move(row));
    }
    return m;
}

std::string markdown(const Matrix& m) {
    std::string same;
    for (std::size_t k = 0; k < m.columns.size(); ++k) {
        if (!changes(m, k))
            same += fmt::format("{}{} `{}`", same.empty() ? "" : ", ", m.columns[k].compiler, m.columns[k].flags);
    }
    std::string out = "No formula changes a bit under: " + same + ".\n\n";
    out += "Answers that change by a bit or more, in per cent of the cases:\n\n";
    out += table(m, [](const Cell& c) { return share(c.changed, c.cases); });
    out +=
        "\nAnswers that get wrong (sign, zero, region, declaration), in per cent; in brackets those that get "
        "right:\n\n";
    out += table(m, [](const Cell& c) {
        const std::string wrong = share(c.newly_wrong, c.cases);
        return c.newly_right == 0 ? wrong : wrong + " (-" + share(c.newly_right, c.cases) + ")";
    });
    return out;
}

std::string json(const Matrix& m) {
    nlohmann::ordered_json j;
    j["schema"] = 1;
    j["command"] = "flags";
    j["seed"] = m.seed;
    j["count"] = m.count;
    j["compilers"] = m.compilers;
    j["families"] = m.families;
    j["columns"] = nlohmann::ordered_json::array();
    for (const Variant& v : m.columns)
        j["columns"].push_back(
            {{"compiler", v.compiler}, {"label", v.label}, {"flags", v.flags}, {"flush_to_zero", v.flush}});
    j["rows"] = nlohmann::ordered_json::array();
    for (const Row& row : m.rows) {
        nlohmann::ordered_json r;
        r["kernel"] = row.kernel;
        r["cells"] = nlohmann::ordered_json::array();
        for (const Cell& c : row.cells) {
            r["cells"].push_back({{"cases", c.cases},
                                  {"changed", c.changed},
                                  {"wrong", c.wrong},
                                  {"newly_wrong", c.newly_wrong},
                                  {"newly_right", c.newly_right},
                                  {"worst_change", c.worst_change}});
        }
        j["rows"].push_back(std::move(r));
    }
    return j.dump(1) + "\n";
}

}  // namespace barycert::flags
