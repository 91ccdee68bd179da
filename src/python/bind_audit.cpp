#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include "barycert/audit_report.hpp"
#include "barycert/choices.hpp"
#include "bindings.hpp"

namespace barycert::python {

template <>
inline constexpr Words<OracleChoice> words<OracleChoice> = named("oracle", OracleChoice::automatic,
                                                                 OracleChoice::integers, OracleChoice::cgal,
                                                                 OracleChoice::both);
template <>
inline constexpr Words<Simplex> words<Simplex> = named("simplex of the kernel", Simplex::segment, Simplex::triangle,
                                                       Simplex::triangle3d, Simplex::tetrahedron);

namespace {

/// A kernel in Python. Kernels are plain functions without data of their own, so there is one place for the callable:
/// one audit at a time has it.
struct Callable {
    py::object function;
    Simplex simplex = Simplex::tetrahedron;
    std::string raised;  ///< by its last call
};
Callable* callable_kernel = nullptr;
std::mutex callable_kernel_in_use;

/// A call of the callable, on this thread. A process that it forks has an end of a pipe, until it ends or runs another
/// program. A process that comes back from the callable without having called it would go on with the audit and the
/// script.
struct Call {
    Call() {
        static const int told_of_forks = ::pthread_atfork(
            [] {
                if (now != nullptr && now->ends[0] < 0 && ::pipe2(now->ends, O_CLOEXEC) != 0) now->ends[0] = -1;
            },
            nullptr, nullptr);
        static_cast<void>(told_of_forks);
        now = this;
    }
    ~Call() {
        now = nullptr;
        for (const int end : ends) {
            if (end >= 0) ::close(end);
        }
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    /// True if a process is left that it has forked. Ends this one if that is it.
    bool left_a_process() {
        if (::getpid() != caller) ::_exit(1);
        if (ends[0] < 0) return false;
        ::close(std::exchange(ends[1], -1));
        pollfd waited{.fd = ends[0], .events = POLLIN, .revents = 0};
        return ::poll(&waited, 1, 0) != 1;  // else the last of them has ended
    }

    static thread_local Call* now;
    pid_t caller = ::getpid();
    int ends[2] = {-1, -1};  ///< to read and to write, once it has forked
};
thread_local Call* Call::now = nullptr;

/// "LinAlgError: Singular matrix".
std::string in_words(const py::error_already_set& e) {
    std::string words = "raised ";
    try {
        words += py::str(e.type().attr("__name__")).cast<std::string>();
        const std::string text = py::str(e.value());
        return words + (text.empty() ? "" : ": " + text);
    } catch (const py::error_already_set& of_text) {
        if (!of_text.matches(PyExc_Exception)) throw;
        return words + ", whose text cannot be had";
    }
}

/// The weights that the callable returns, or None: declared degenerate. An exception that it raises is no answer; what
/// is no Exception, such as KeyboardInterrupt, ends the audit, and so do an answer of another shape and a process that
/// it leaves behind.
int call_kernel(const double* vertices, const double* point, double* weights) {
    const py::gil_scoped_acquire lock;
    const Simplex simplex = callable_kernel->simplex;
    const int n = vertex_count(simplex), d = space_dimension(simplex);
    py::object answer = py::none();
    callable_kernel->raised.clear();
    Call call;
    try {
        answer = callable_kernel->function(py::array_t<double>({n, d}, vertices), py::array_t<double>(d, point));
    } catch (const py::error_already_set& e) {
        if (::getpid() == call.caller && !e.matches(PyExc_Exception)) throw;
        callable_kernel->raised = in_words(e);
    }
    if (call.left_a_process())
        throw Exception({.code = "kernel.process",
                         .what = "the kernel left a process behind that it had forked",
                         .remedy = "let it end its processes, and wait for them, before it returns"});
    if (answer.is_none()) return 1;
    const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(answer);
    if (numbers.ndim() != 1 || numbers.size() != n)
        throw Exception({.code = "kernel.result",
                         .what = "what the kernel returned",
                         .expected = std::to_string(n) + " weights, or None for a degenerate simplex",
                         .found = py::repr(answer)});
    std::copy_n(numbers.data(), n, weights);
    return 0;
}

Kernel kernel_of(Simplex simplex, const std::string& name, bool declares, std::optional<double> tolerance) {
    // How weights and nodal values make a value is the same for all kernels of a simplex.
    const auto same = std::ranges::find_if(
        catalogue(), [&](const Kernel& k) { return k.simplex == simplex && !k.perspective && k.value != nullptr; });
    Kernel kernel;
    kernel.name = std::string(barycert::name(simplex)) + "." + name;
    kernel.simplex = simplex;
    kernel.formula = "a callable of Python";
    kernel.declares_degenerate = declares;
    kernel.weights = call_kernel;
    kernel.raised = [] { return callable_kernel->raised; };
    kernel.value = same->value;
    kernel.rule = tolerance ? RegionRule::tolerant : RegionRule::sign;
    kernel.tolerance = tolerance.value_or(0);
    return kernel;
}

/// Returns what was chosen by names, or throws an Error that says what lists the names in Python.
template <class T>
T named(Result<T> chosen, const char* lists) {
    if (chosen) return std::move(*chosen);
    Error error = chosen.error();
    error.remedy = lists;
    throw Exception(std::move(error));
}

/// `function`: a callable, or None.
std::shared_ptr<AuditReport> audit(const py::object& function, Simplex simplex, const std::string& name,
                                   bool declares_degenerate, std::optional<double> tolerance,
                                   const std::vector<std::string>& libraries, const std::vector<std::string>& catalogue,
                                   bool contained, std::uint64_t count, std::uint64_t seed,
                                   const std::vector<std::string>& families,
                                   const std::vector<std::pair<std::string, const MeshObject*>>& meshes, int threads,
                                   OracleChoice oracle, const Progress& progress) {
    AuditOptions options;
    options.count = count;
    options.seed = seed;
    options.threads = threads;
    options.oracle = oracle;
    options.families = named(choose_families(families), "barycert.families() lists them");
    if (families.empty() && meshes.empty())
        std::erase_if(options.families, [](const Family& f) { return f.needs_mesh; });
    options.progress = [&](const AuditProgress& p) { tell(progress, p.family, p.cases_done, p.cases_total); };
    Callable callable;
    if (!function.is_none()) {
        callable = {function, simplex, {}};
        options.kernels.push_back(kernel_of(simplex, name, declares_degenerate, tolerance));
        // Python runs one thread at a time; and in this one it sees Ctrl-C.
        options.threads = 1;
    }
    const py::gil_scoped_release unlocked;
    const auto add = [&](const std::vector<Kernel>& some) {
        options.kernels.insert(options.kernels.end(), some.begin(), some.end());
    };
    if (!libraries.empty())
        add(choose_kernels({.libraries = libraries, .in_process = !contained, .class_tolerance = tolerance}).value());
    if (!catalogue.empty()) add(named(choose_kernels({.names = catalogue}), "barycert.kernels() lists them"));
    MeshSource source;
    for (const auto& [label, mesh] : meshes) source.add(label, mesh->mesh());
    std::unique_lock<std::mutex> turn;
    if (callable.function) {
        if (Call::now != nullptr)
            throw Exception({.code = "argument.value",
                             .what = "an audit of a callable within an audit",
                             .remedy = "begin it when the other has ended"});
        turn = std::unique_lock(callable_kernel_in_use);
        callable_kernel = &callable;
    }
    return std::make_shared<AuditReport>(run_audit(options, source).value());
}

std::string html_of(const AuditReport& report) {
    std::vector<Kernel> kernels;
    for (const KernelResult& k : report.kernels) {
        // A picture asks the kernel, and the callable is gone.
        if (k.kernel.weights != call_kernel) kernels.push_back(k.kernel);
    }
    return audit_html(report, {.style = {}, .command_line = {}, .signs = sign_pictures(kernels)}).value();
}

}  // namespace

void bind_audit(py::module_& module) {
    module.attr("has_audit") = true;
    py::class_<AuditReport, std::shared_ptr<AuditReport>>(module, "AuditReport")
        .def("json", &audit_json)
        .def("text", [](const AuditReport& r, bool wide) { return audit_text(r, {.wide = wide}); })
        .def("html", &html_of);
    module.def("audit", &audit);
    module.def("finding_names", [] { return list_of(finding_texts, [](const FindingText& f) { return f.name; }); });
    module.def("kernels", [] { return kernels_json(catalogue()); });
    module.def("families", [] { return families_json(all_families()); });
}

}  // namespace barycert::python
