#include "barycert/audit.hpp"
#include "barycert/audit/comparison.hpp"
#include "barycert/audit/search/evaluation.hpp"

#include <algorithm>
#include <span>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"

namespace barycert {

using namespace audit;

namespace {

KernelAnswer answer_of(const Kernel& kernel, const Case& c, const OracleAnswer& exact) {
    KernelAnswer a;
    Statement said;
    a.detail = ask_kernel(kernel, std::span(&c, 1), std::span(&said, 1), false).detail;
    a.kernel = kernel.name;
    a.answered = said.answered;
    a.status = said.status;
    a.weights = said.weights;
    a.comparison = compare(kernel, c, exact, said);
    a.worst_weight_ulp = *std::max_element(a.comparison.weight_ulps.begin(), a.comparison.weight_ulps.end());
    return a;
}

std::string not_reproduced(const Replay& r, const std::vector<Kernel>& kernels) {
    const Witness& w = r.witness;
    if (w.kernel.empty() || w.reason.empty()) return "";
    const std::size_t reason = search_reason_named(w.reason);
    if (reason == search_reasons) return "no class of finding has that name";
    const auto named = [&](const auto& x) { return x.name == w.kernel; };
    if (std::none_of(kernels.begin(), kernels.end(), named)) {
        return "no kernel of that name here; name its library with job.kernel_library";
    }
    const auto a =
        std::find_if(r.answers.begin(), r.answers.end(), [&](const auto& x) { return x.kernel == w.kernel; });
    if (a == r.answers.end()) return "the kernel is for another simplex";
    if (reason < finding_count) {
        if (a->comparison.counts[reason] != 0) return "";
        return is_incident(reason)
                   ? "asked once more, the kernel did not; it may depend on the cases before, or on chance"
                   : "the kernel's answer does not have this finding";
    }
    // Errors come out the same wherever the kernel was compiled to the same arithmetic.
    if (reason == witness_reasons) {
        const double error = relative_error(r.exact, a->comparison);
        return error == w.magnitude ? ""
                                    : "the error is " + base::shortest(error) + ", not " + base::shortest(w.magnitude);
    }
    const double ulps = w.reason == "worst_value_ulp" ? a->comparison.value_ulp : a->worst_weight_ulp;
    return ulps == w.magnitude ? ""
                               : "the error is " + base::shortest(ulps) + " ulps, not " + base::shortest(w.magnitude);
}

}  // namespace

Replay replay_witness(const Witness& witness, const std::vector<Kernel>& kernels) {
    const ExactEnvironment environment;
    Replay r;
    r.witness = witness;
    const Case& c = witness.c;
    r.exact = ask_oracle(c);
    r.affine_dimension = affine_dimension(c);
    if (c.simplex == Simplex::triangle)
        r.identity = c.perspective ? perspective_is_ray_casting(c) : bilinear_is_barycentric(c);
    if (c.simplex == Simplex::tetrahedron) r.identity = trilinear_is_barycentric(c);
    for (const Kernel& k : kernels) {
        if (k.simplex == c.simplex && k.perspective == c.perspective) r.answers.push_back(answer_of(k, c, r.exact));
    }
    r.not_reproduced = not_reproduced(r, kernels);
    return r;
}

}  // namespace barycert
