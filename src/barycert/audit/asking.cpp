#include "barycert/audit/asking.hpp"

#include <algorithm>
#include <chrono>

#include "barycert/environment.hpp"
#include "barycert/kernels/host.hpp"

namespace barycert::audit {
namespace {

Region region_of(int number) {
    return number >= 0 && number < 4 ? static_cast<Region>(number) : Region::degenerate;
}

/// The region by the kernel's rule; `own` is its own classification.
Region claim(const Kernel& kernel, const Statement& s, std::size_t n, int own) {
    if (kernel.rule != RegionRule::own) return claimed_region(kernel, s.status, std::span(s.weights).first(n));
    return s.status != 0 ? Region::degenerate : region_of(own);
}

Asked ask_in_process(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements) {
    using Clock = std::chrono::steady_clock;
    const WeightsFunction function = kernel.weights;
    // A weight that the kernel leaves unset must not look like an answer, least of all another kernel's.
    std::fill(statements.begin(), statements.end(), Statement{});
    std::string detail;
    const auto start = Clock::now();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Statement& s = statements[i];
        s.status = function(cases[i].vertices.data(), cases[i].point.data(), s.weights.data());
        if (s.status == 0 || kernel.raised == nullptr) continue;
        const std::string raised = kernel.raised();
        if (raised.empty()) continue;
        s = {.answered = false, .incidents = kernels::incident_raised};
        if (detail.empty()) detail = raised;
    }
    const auto stop = Clock::now();
    // A kernel may leave another rounding mode behind: it is its own affair, not the oracle's or the next one's.
    ExactEnvironment::renew();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (statements[i].answered) complete(statements[i], kernel, cases[i]);
    }
    return {.ns = std::chrono::duration<double, std::nano>(stop - start).count() /
                  static_cast<double>(std::max<std::size_t>(cases.size(), 1)),
            .detail = detail};
}

Asked ask_host(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements, bool timed) {
    std::array<kernels::Host::Reply, kernels::batch_size> replies;
    using Host = kernels::Host;
    const Host::Batch batch = kernel.host->run(cases, std::span(replies).first(cases.size()),
                                               timed ? Host::Asking::timed : Host::Asking::usual);
    const auto n = static_cast<std::size_t>(vertex_count(kernel.simplex));
    const bool interpolates = kernel.host->description().interpolates;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const kernels::Host::Reply& reply = replies[i];
        Statement& s = statements[i];
        s = {.ran = reply.ran,
             .answered = reply.answered,
             .status = reply.answer.status,
             .weights = reply.answer.weights,
             .incidents = reply.answer.incidents};
        if (!s.answered) continue;
        s.claimed = claim(kernel, s, n, reply.answer.region);
        if (s.status == 0)
            s.value = interpolates ? reply.answer.value : kernel.value(s.weights.data(), cases[i].values.data());
    }
    return {.ns = batch.ns, .detail = batch.detail};
}

}  // namespace

void complete(Statement& s, const Kernel& kernel, const Case& c) {
    int own = 0;
    if (s.status == 0) {
        if (kernel.classify != nullptr) own = kernel.classify(c.vertices.data(), c.point.data(), s.weights.data());
        s.value = kernel.interpolate != nullptr ? kernel.interpolate(c.vertices.data(), c.point.data(), c.values.data())
                                                : kernel.value(s.weights.data(), c.values.data());
        ExactEnvironment::renew();
    }
    s.claimed = claim(kernel, s, static_cast<std::size_t>(vertex_count(c.simplex)), own);
}

std::string incident_of(const Kernel& kernel, const Case& c) {
    const ExactEnvironment environment;
    if (kernel.host == nullptr) {
        Statement said;
        return kernel.raised == nullptr ? "" : ask_in_process(kernel, std::span(&c, 1), std::span(&said, 1)).detail;
    }
    kernels::Host::Reply reply;
    return kernel.host->run(std::span(&c, 1), std::span(&reply, 1), kernels::Host::Asking::given_up_too).detail;
}

Asked ask_kernel(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements, bool timed) {
    const ExactEnvironment environment;
    return kernel.host != nullptr ? ask_host(kernel, cases, statements, timed)
                                  : ask_in_process(kernel, cases, statements);
}

}  // namespace barycert::audit
