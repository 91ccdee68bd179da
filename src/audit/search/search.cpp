#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "audit/search/evaluation.hpp"
#include "audit/search/moves.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"
#include "core/base/workers.hpp"

namespace barycert {

using namespace audit;

namespace {

/// Walks of one round do not know of each other: so threads change nothing.
constexpr std::uint64_t walks_per_round = 32, steps_per_walk = 1000;
constexpr std::uint64_t patience = 100;  ///< steps without a rise before the walk goes down
constexpr std::size_t kept = 12;         ///< worst cases of a reason to start from

const MeshSource no_meshes;

/// A case that showed a reason, and what is told of it: the kernel may end before it could be asked again.
struct Met {
    Case c;
    int cost = std::numeric_limits<int>::max();  ///< plain_cost()
    Height height;
    Evaluation evaluation;
};

/// Cases that a walk met, or that all walks met so far.
struct Harvest {
    std::uint64_t steps = 0, wrong_cases = 0;
    std::array<std::uint64_t, search_reasons> cases{};
    std::array<std::vector<Met>, search_reasons> worst;  ///< worst first, at most `kept`; of a walk one
    std::array<Met, finding_count> plain;                ///< the plainest of each finding
    bool given_up = false;                               ///< the kernel failed to answer too often

    void add(const Case& c, const Evaluation& e) {
        if (!e.said.ran) {
            given_up = true;
            return;
        }
        ++steps;
        if (e.comparison.wrong()) ++wrong_cases;
        std::optional<int> cost;
        for (std::size_t r = 0; r < search_reasons; ++r) {
            const Height h = height(r, e);
            if (h.shown < 0) continue;
            ++cases[r];
            if (!cost) cost = plain_cost(c);
            if (worst[r].empty() || worst[r].front().height < h) worst[r] = {{c, *cost, h, e}};
            if (r < finding_count && *cost < plain[r].cost) plain[r] = {c, *cost, h, e};
        }
    }

    /// Equal ones stay in the order of their coming.
    void include(std::size_t r, const Met& m) {
        std::vector<Met>& list = worst[r];
        const auto at = std::ranges::find_if(list, [&](const Met& x) { return x.height < m.height; });
        list.insert(at, m);
        if (list.size() > kept) list.pop_back();
    }

    void take(const Harvest& other) {
        steps += other.steps;
        wrong_cases += other.wrong_cases;
        given_up = given_up || other.given_up;
        for (std::size_t r = 0; r < search_reasons; ++r) {
            cases[r] += other.cases[r];
            for (const Met& m : other.worst[r]) include(r, m);
            if (r < finding_count && other.plain[r].cost < plain[r].cost) plain[r] = other.plain[r];
        }
    }
};

class Search {
public:
    explicit Search(const SearchOptions& o) : o_(o), range_{o.min_exponent, o.max_exponent} {
        for (const Family& f : o.families) {
            if (!f.needs_mesh && f.applies_to(o.kernel.simplex) && f.perspective == o.kernel.perspective)
                families_.push_back(f);
        }
        for (auto r = static_cast<std::size_t>(Finding::false_certificate); r < search_reasons; ++r) {
            const bool cannot = (is_finding(r, Finding::false_certificate) && !o.kernel.certifies) ||
                                (is_finding(r, Finding::false_declaration) && !o.kernel.declares_degenerate);
            if (!cannot) targets_.push_back(r);
        }
    }

    /// Each family's first cases: those of one family are one task, of which the worst of each reason go on.
    Harvest begin(std::size_t family, std::uint64_t steps) const {
        Harvest h;
        for (std::uint64_t i = 0; i < steps && !h.given_up; ++i) {
            const Case c = make_case(families_[family], o_.kernel.simplex, o_.seed, i, no_meshes);
            // One that is beyond the range of exponents is made, but not asked.
            if (admissible(c, range_)) h.add(c, evaluate(o_.kernel, c));
        }
        return h;
    }

    Harvest walk(const Harvest& before, std::uint64_t number, std::uint64_t steps) const {
        base::Random random = base::Random::stream(o_.seed, base::hash64(o_.kernel.name), number);
        Harvest h;
        const std::size_t reason = targets_[number % targets_.size()];
        const bool values = reason == finding_count + 1 || o_.kernel.certifies;
        Case here = start(before, reason, random);
        Evaluation evaluation = evaluate(o_.kernel, here);
        h.add(here, evaluation);
        std::uint64_t waited = 0;
        Evaluation answer;
        const auto ask = [&](const Case& c) -> const Evaluation* {
            if (h.steps >= steps || h.given_up) return nullptr;
            answer = evaluate(o_.kernel, c);
            h.add(c, answer);
            return h.given_up ? nullptr : &answer;
        };
        // Moves that lead out of the range cost no step, but must come to an end, too.
        for (std::uint64_t moves = 0; h.steps < steps && moves < 8 * steps && !h.given_up; ++moves) {
            Case next = here;
            if (random.below(8) == 0) {
                jump_to_zero(next, evaluation, random, range_, ask);
            } else {
                wander(next, random, values);
            }
            if (!admissible(next, range_) || ask(next) == nullptr) continue;
            const Height next_height = height(reason, answer), height_here = height(reason, evaluation);
            if (next_height < height_here && waited < patience) {
                ++waited;
                continue;
            }
            here = next;
            evaluation = answer;
            if (next_height != height_here) waited = 0;
        }
        return h;
    }

    std::size_t family_count() const { return families_.size(); }

private:
    Case start(const Harvest& before, std::size_t reason, base::Random& random) const {
        const auto kind = random.below(4);
        const std::vector<Met>& worst = before.worst[reason];
        if (kind < 2 && !worst.empty()) return worst[random.below(worst.size())].c;
        if (kind == 2 && !families_.empty()) {
            const Family& family = families_[random.below(families_.size())];
            const std::uint64_t index = o_.family_count + random.below(std::uint64_t{1} << 32);
            Case c = make_case(family, o_.kernel.simplex, o_.seed, index, no_meshes);
            if (admissible(c, range_)) return c;
        }
        return patterned_case(o_.kernel.simplex, o_.kernel.perspective, range_, random);
    }

    const SearchOptions& o_;
    ExponentRange range_;
    std::vector<Family> families_;
    std::vector<std::size_t> targets_;  ///< reasons that walks go for, in turn
};

Witness witness_of(const SearchOptions& o, std::size_t reason, const Met& met) {
    Witness w;
    w.kernel = o.kernel.name;
    w.reason = search_reason_name(reason);
    w.family = "search";
    w.seed = o.seed;
    w.magnitude = magnitude(reason, met.evaluation);
    w.detail = is_incident(reason) ? met.evaluation.detail : "";
    w.c = met.c;
    return w;
}

struct Shown {
    SearchFind find;
    std::uint64_t plain_steps = 0;
    bool given_up = false;
};

Shown shown(const SearchOptions& o, std::size_t reason, const Harvest& all) {
    const Met &worst = all.worst[reason].front(), &met = reason < finding_count ? all.plain[reason] : worst;
    Shown s;
    SearchFind& f = s.find;
    f.reason = search_reason_name(reason);
    f.cases = all.cases[reason];
    f.found = witness_of(o, reason, worst);
    f.weight_ulp = worst.evaluation.comparison.worst_weight_ulp();
    f.relative_error = worst.evaluation.relative_error;
    f.plain = witness_of(o, reason, met);
    Evaluation e = met.evaluation;
    // Each trial of an accident may cost a process, or the time limit: the plainest that was met is plain enough.
    if (!is_accident(reason) && !all.given_up) {
        const auto plainest = [&](const Witness& w) {
            return plainest_witness(o.kernel, w, &s.plain_steps, o.min_exponent, o.max_exponent);
        };
        Witness plain = plainest(f.found);
        if (reason < finding_count) {
            Witness other = plainest(f.plain);
            if (plain_cost(other.c) < plain_cost(plain.c)) plain = std::move(other);
        }
        const Evaluation p = evaluate(o.kernel, plain.c);
        s.given_up = !p.said.ran;
        if (p.said.ran) {
            f.plain = std::move(plain);
            if (is_incident(reason)) f.plain.detail = p.detail;
            e = p;
        }
    }
    f.plain_weight_ulp = e.comparison.worst_weight_ulp();
    f.plain_relative_error = e.relative_error;
    for (int k = 0; k < coordinate_count(f.plain.c); ++k) f.plain_bits += significant_bits(coordinate(f.plain.c, k));
    return s;
}

Status check(const SearchOptions& o) {
    if (o.steps == 0)
        return Error{.code = "option.value", .what = "a search of no steps", .expected = "at least 1", .found = "0"};
    if (o.min_exponent > o.max_exponent || o.min_exponent < -1074 || o.max_exponent > 1023)
        return file_error("option.value", {}, "the exponents of a search", "LOW:HIGH with -1074 <= LOW <= HIGH <= 1023",
                          std::to_string(o.min_exponent) + ":" + std::to_string(o.max_exponent));
    if (o.kernel.weights == nullptr && o.kernel.host == nullptr)
        return Error{.code = "option.missing", .what = "a search without a kernel"};
    return Done{};
}

}  // namespace

Result<SearchReport> search_worst_case(const SearchOptions& o) {
    const ExactEnvironment exact;
    if (const Status ok = check(o); !ok) return ok.error();
    SearchReport report;
    report.environment = measure_environment();
    if (const Status ok = check_environment(report.environment); !ok) return ok.error();
    report.kernel = o.kernel;
    report.seed = o.seed;
    report.steps_asked = o.steps;
    report.min_exponent = o.min_exponent;
    report.max_exponent = o.max_exponent;
    report.threads = base::threads_for(o.threads);

    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const Search search(o);
    Harvest all;
    // A round of tasks side by side, gathered in their order.
    const auto round = [&](std::size_t tasks, const auto& task) {
        std::vector<Harvest> harvests(tasks);
        on_threads(report.threads, tasks, [&](std::size_t i) { harvests[i] = task(i); });
        for (const Harvest& h : harvests) all.take(h);
        const double ulps = all.worst[finding_count].empty() ? -1 : all.worst[finding_count].front().height.shown;
        const bool go_on = !o.progress || o.progress({all.steps, o.steps, ulps, all.wrong_cases});
        ExactEnvironment::renew();
        report.stopped = !go_on || (o.seconds > 0 && elapsed() >= o.seconds);
    };

    if (const std::size_t families = search.family_count(); families != 0) {
        const std::uint64_t each = std::min(o.family_count, o.steps / families);
        round(families, [&](std::size_t i) { return search.begin(i, each); });
    }
    while (!report.stopped && !all.given_up && all.steps < o.steps) {
        const std::uint64_t left = o.steps - all.steps;
        const std::uint64_t tasks = std::min(walks_per_round, (left + steps_per_walk - 1) / steps_per_walk);
        const Harvest& before = all;
        round(tasks, [&](std::size_t i) {
            const std::uint64_t share = std::min(steps_per_walk, left - i * steps_per_walk);
            return search.walk(before, report.walks + i, share);
        });
        report.walks += tasks;
    }
    if (all.steps >= o.steps) report.stopped = false;
    report.steps = all.steps;
    report.wrong_cases = all.wrong_cases;
    std::vector<std::size_t> reasons;
    for (std::size_t r = 0; r < search_reasons; ++r) {
        // An error of zero is none.
        const bool met = !all.worst[r].empty() && (r < finding_count || all.worst[r].front().height.shown > 0);
        if (met) reasons.push_back(r);
    }
    report.given_up = all.given_up;
    std::vector<Shown> finds(reasons.size());
    on_threads(report.threads, reasons.size(), [&](std::size_t i) { finds[i] = shown(o, reasons[i], all); });
    for (Shown& s : finds) {
        report.plain_steps += s.plain_steps;
        report.given_up = report.given_up || s.given_up;
        report.finds.push_back(std::move(s.find));
    }
    report.seconds = elapsed();
    return report;
}

}  // namespace barycert
