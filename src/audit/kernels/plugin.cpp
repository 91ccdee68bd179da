// Kernels from shared libraries: barycert/kernel.h.
#include <dlfcn.h>

#include <algorithm>
#include <cfenv>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "audit/kernels/channel.hpp"
#include "audit/kernels/host.hpp"
#include "audit/kernels/registry.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernel.h"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {
namespace {

using kernels::Description;

/// The characters of a kernel's name, so that it survives shells, globs and file names.
constexpr const char* usable = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";

/// The kernel that a library describes, its functions aside.
Result<Kernel> described(const std::string& path, const Description& d) {
    if (d.missing[0] != '\0')
        return file_error("kernel.interface", path, "the library is not a kernel library",
                          std::string("the function ") + d.missing, "none",
                          "define it as barycert/kernel.h declares it, with C linkage and default visibility");
    if (d.abi != BARYCERT_KERNEL_ABI)
        return file_error("kernel.interface", path, "the kernel library has another interface version",
                          std::to_string(BARYCERT_KERNEL_ABI), std::to_string(d.abi),
                          "set info->abi = BARYCERT_KERNEL_ABI and rebuild it with this version's barycert/kernel.h");
    const bool perspective = std::string_view(d.simplex) == "triangle.perspective";
    const auto simplex = perspective ? Simplex::triangle : simplex_named(d.simplex);
    if (!simplex)
        return file_error("kernel.interface", path, "the kernel library names an unknown simplex",
                          "segment, triangle, triangle3d, tetrahedron or triangle.perspective",
                          std::string("\"") + d.simplex + '"', "set info->simplex to one of these");
    if (d.name[0] == '\0' || d.name[std::strspn(d.name, usable)] != '\0')
        return file_error("kernel.name", path, "the kernel library has an unusable name", "letters, digits, -, _ and .",
                          std::string("\"") + d.name + '"', "set info->name accordingly");
    const std::string name = std::string(perspective ? "perspective-" : "") + d.name;
    Kernel k =
        kernels::make_kernel(*simplex, {name.c_str(), d.formula, d.source, "", nullptr,
                                        d.declares_degenerate != 0 ? kernels::Declares::yes : kernels::Declares::no});
    k.certifies = d.certifies != 0;
    k.perspective = perspective;
    if (d.classifies) k.rule = RegionRule::own;
    if (std::ranges::find(catalogue(), k.name, &Kernel::name) != catalogue().end())
        return file_error("kernel.name", path, "the kernel library takes the name of a kernel of the catalogue",
                          "another name", k.name, "change info->name");
    return k;
}

Error not_loaded(const std::string& path, std::string found) {
    return file_error("kernel.load", path, "cannot load the kernel library", "", std::move(found),
                      "give the path of a shared library for this machine, all of whose symbols can be resolved");
}

}  // namespace

kernels::LibraryFunctions::LibraryFunctions(void* library) {
    const auto find = [&]<class Function>(const char* name, Function& function) {
        function = reinterpret_cast<Function>(dlsym(library, name));
    };
    find("barycert_kernel_describe", describe);
    find("barycert_kernel_weights", weights);
    find("barycert_kernel_classify", classify);
    find("barycert_kernel_value", value);
}

Description kernels::LibraryFunctions::described() const {
    Description d;
    if (describe == nullptr || weights == nullptr) {
        put(d.missing, describe == nullptr ? "barycert_kernel_describe" : "barycert_kernel_weights");
        return d;
    }
    barycert_kernel_info info{};
    describe(&info);
    d.abi = info.abi;
    d.declares_degenerate = info.declares_degenerate;
    d.certifies = info.certifies;
    d.classifies = classify != nullptr;
    d.interpolates = value != nullptr;
    put(d.name, info.name);
    put(d.simplex, info.simplex);
    put(d.formula, info.formula);
    put(d.source, info.source);
    return d;
}

Result<Kernel> load_kernel_library(const std::string& path) {
    // Without a slash dlopen would search the system's library folders instead of the working directory.
    const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
    if (Status whole = kernels::check_shared_library(path); !whole) return whole.error();
    // A library linked with -ffast-math sets flush-to-zero when it is loaded: that stays its own affair.
    std::fenv_t before;
    std::fegetenv(&before);
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    std::fesetenv(&before);
    if (library == nullptr) return not_loaded(path, dlerror());
    const kernels::LibraryFunctions functions(library);
    const Description description = functions.described();
    std::fesetenv(&before);
    Result<Kernel> kernel = described(path, description);
    if (!kernel) {
        dlclose(library);
        return kernel;
    }
    kernel->weights = functions.weights;
    kernel->classify = functions.classify;
    kernel->interpolate = functions.value;
    return kernel;
}

Result<Kernel> load_contained_kernel(const std::string& path, double seconds) {
    const ExactEnvironment environment;
    if (Status whole = kernels::check_shared_library(path); !whole) return whole.error();
    Result<std::shared_ptr<kernels::Host>> host = kernels::Host::start(path, seconds);
    if (!host) return host.error();
    const Description& d = (*host)->description();
    if (d.error[0] != '\0') return not_loaded(path, d.error);
    Result<Kernel> kernel = described(path, d);
    if (!kernel) return kernel;
    if (d.note[0] != '\0')
        kernel->note = std::string("loading it changes the floating-point environment: ") + d.note +
                       "; the audit sets it right again, a program that uses the library may not";
    kernel->host = *host;
    return kernel;
}

}  // namespace barycert
