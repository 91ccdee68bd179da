// Kernels from shared libraries: barycert/kernel.h.
#include <dlfcn.h>

#include <algorithm>
#include <cfenv>
#include <string>
#include <utility>

#include "barycert/kernel.h"
#include "barycert/kernels.hpp"
#include "barycert/kernels/elf_file.hpp"
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

Result<Kernel> described(const std::string& path, const barycert_kernel_info& info, WeightsFunction weights) {
    if (info.abi != BARYCERT_KERNEL_ABI) {
        return refused(path, "the kernel library has another interface version", std::to_string(BARYCERT_KERNEL_ABI),
                       std::to_string(info.abi),
                       "set info->abi = BARYCERT_KERNEL_ABI and rebuild it with this version's barycert/kernel.h");
    }
    const std::string simplex_name = text_or_empty(info.simplex), formula_name = text_or_empty(info.name);
    const bool perspective = simplex_name == "triangle.perspective";
    const auto simplex = perspective ? Simplex::triangle : simplex_named(simplex_name);
    if (!simplex) {
        return refused(path, "the kernel library names an unknown simplex",
                       "segment, triangle, triangle3d, tetrahedron or triangle.perspective", '"' + simplex_name + '"',
                       "set info->simplex to one of these");
    }
    if (!well_formed(formula_name)) {
        return refused(path, "the kernel library has an unusable name", "letters, digits, -, _ and .",
                       '"' + formula_name + '"', "set info->name accordingly");
    }
    const std::string formula = text_or_empty(info.formula), source = text_or_empty(info.source);
    Kernel k = kernels::make_kernel(*simplex, (perspective ? "perspective-" : "") + formula_name, weights,
                                    info.declares_degenerate != 0 ? kernels::Declares::yes : kernels::Declares::no,
                                    {formula.c_str(), source.c_str(), ""});
    k.certifies = info.certifies != 0;
    k.perspective = perspective;
    const auto same_name = [&](const Kernel& other) { return other.name == k.name; };
    if (std::any_of(catalogue().begin(), catalogue().end(), same_name)) {
        return refused(path, "the kernel library takes the name of a kernel of the catalogue", "another name", k.name,
                       "change info->name");
    }
    return k;
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
    if (library == nullptr) {
        return refused(path, "cannot load the kernel library", "", text_or_empty(dlerror()),
                       "give the path of a shared library for this machine, all of whose symbols can be resolved");
    }
    const auto describe = reinterpret_cast<DescribeFunction>(dlsym(library, "barycert_kernel_describe"));
    const auto weights = reinterpret_cast<WeightsFunction>(dlsym(library, "barycert_kernel_weights"));
    if (describe == nullptr || weights == nullptr) {
        const char* const missing = describe == nullptr ? "barycert_kernel_describe" : "barycert_kernel_weights";
        dlclose(library);
        return refused(path, "the library is not a kernel library", std::string("the function ") + missing, "none",
                       "define it as barycert/kernel.h declares it, with C linkage and default visibility");
    }
    barycert_kernel_info info{};
    describe(&info);
    std::fesetenv(&before);
    Result<Kernel> kernel = described(path, info, weights);
    if (!kernel) dlclose(library);
    return kernel;
}

}  // namespace barycert
