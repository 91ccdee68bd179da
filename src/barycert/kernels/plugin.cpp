// Kernels from shared libraries: barycert/kernel.h.
#include <dlfcn.h>

#include <algorithm>
#include <cfenv>
#include <string>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/kernel.h"
#include "barycert/kernels.hpp"
#include "barycert/kernels/elf_file.hpp"
#include "barycert/kernels/host.hpp"
#include "barycert/kernels/registry.hpp"

namespace barycert {
namespace {

using DescribeFunction = void (*)(barycert_kernel_info*);

std::string text_or_empty(const char* text) {
    return text == nullptr ? "" : text;
}

/// Letters, digits, -, _ and ., so that a name survives shells, globs and file names.
bool well_formed(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
               c == '.';
    });
}

Error refused(const std::string& path, std::string what, std::string expected, std::string found, std::string remedy) {
    return {std::move(what), path, 0, std::move(expected), std::move(found), std::move(remedy)};
}

struct Promises {
    bool declares_degenerate = false, certifies = false;
};

struct Texts {
    std::string name, simplex, formula, source;
};

/// The kernel that a library describes, its functions aside.
Result<Kernel> described(const std::string& path, int abi, const Texts& texts, const Promises& promises) {
    if (abi != BARYCERT_KERNEL_ABI) {
        return refused(path, "the kernel library has another interface version", std::to_string(BARYCERT_KERNEL_ABI),
                       std::to_string(abi),
                       "set info->abi = BARYCERT_KERNEL_ABI and rebuild it with this version's barycert/kernel.h");
    }
    const bool perspective = texts.simplex == "triangle.perspective";
    const auto simplex = perspective ? Simplex::triangle : simplex_named(texts.simplex);
    if (!simplex) {
        return refused(path, "the kernel library names an unknown simplex",
                       "segment, triangle, triangle3d, tetrahedron or triangle.perspective", '"' + texts.simplex + '"',
                       "set info->simplex to one of these");
    }
    if (!well_formed(texts.name)) {
        return refused(path, "the kernel library has an unusable name", "letters, digits, -, _ and .",
                       '"' + texts.name + '"', "set info->name accordingly");
    }
    Kernel k = kernels::make_kernel(*simplex, (perspective ? "perspective-" : "") + texts.name, nullptr,
                                    promises.declares_degenerate ? kernels::Declares::yes : kernels::Declares::no,
                                    {texts.formula.c_str(), texts.source.c_str(), ""});
    k.certifies = promises.certifies;
    k.perspective = perspective;
    const auto same_name = [&](const Kernel& other) { return other.name == k.name; };
    if (std::any_of(catalogue().begin(), catalogue().end(), same_name)) {
        return refused(path, "the kernel library takes the name of a kernel of the catalogue", "another name", k.name,
                       "change info->name");
    }
    return k;
}

Error not_loaded(const std::string& path, std::string found) {
    return refused(path, "cannot load the kernel library", "", std::move(found),
                   "give the path of a shared library for this machine, all of whose symbols can be resolved");
}

Error no_kernel_library(const std::string& path, const std::string& missing) {
    return refused(path, "the library is not a kernel library", "the function " + missing, "none",
                   "define it as barycert/kernel.h declares it, with C linkage and default visibility");
}

}  // namespace

Result<Kernel> load_kernel_library(const std::string& path) {
    // Without a slash dlopen would search the system's library folders instead of the working directory.
    const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
    if (Status whole = kernels::check_shared_library(path); !whole) return whole.error();
    // A library linked with -ffast-math sets flush-to-zero when it is loaded: that stays its own affair.
    std::fenv_t before;
    std::fegetenv(&before);
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    std::fesetenv(&before);
    if (library == nullptr) return not_loaded(path, text_or_empty(dlerror()));
    const auto describe = reinterpret_cast<DescribeFunction>(dlsym(library, "barycert_kernel_describe"));
    const auto weights = reinterpret_cast<WeightsFunction>(dlsym(library, "barycert_kernel_weights"));
    if (describe == nullptr || weights == nullptr) {
        dlclose(library);
        return no_kernel_library(path, describe == nullptr ? "barycert_kernel_describe" : "barycert_kernel_weights");
    }
    barycert_kernel_info info{};
    describe(&info);
    std::fesetenv(&before);
    Result<Kernel> kernel = described(path, info.abi,
                                      {text_or_empty(info.name), text_or_empty(info.simplex),
                                       text_or_empty(info.formula), text_or_empty(info.source)},
                                      {info.declares_degenerate != 0, info.certifies != 0});
    if (!kernel) {
        dlclose(library);
        return kernel;
    }
    kernel->weights = weights;
    kernel->classify = reinterpret_cast<ClassifyFunction>(dlsym(library, "barycert_kernel_classify"));
    kernel->interpolate = reinterpret_cast<CaseValueFunction>(dlsym(library, "barycert_kernel_value"));
    if (kernel->classify != nullptr) kernel->rule = RegionRule::own;
    return kernel;
}

Result<Kernel> load_contained_kernel(const std::string& path, double seconds) {
    const ExactEnvironment environment;
    if (Status whole = kernels::check_shared_library(path); !whole) return whole.error();
    Result<std::shared_ptr<kernels::Host>> host = kernels::Host::start(path, seconds);
    if (!host) return host.error();
    const kernels::Description& d = (*host)->description();
    if (d.error[0] != '\0') return not_loaded(path, d.error);
    if (d.missing[0] != '\0') return no_kernel_library(path, d.missing);
    Result<Kernel> kernel = described(path, d.abi, {d.name, d.simplex, d.formula, d.source},
                                      {d.declares_degenerate != 0, d.certifies != 0});
    if (!kernel) return kernel;
    if (d.classifies) kernel->rule = RegionRule::own;
    if (d.note[0] != '\0')
        kernel->note = std::string("loading it changes the floating-point environment: ") + d.note +
                       "; the audit sets it right again, a program that uses the library may not";
    kernel->host = *host;
    return kernel;
}

}  // namespace barycert
