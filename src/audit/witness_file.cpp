#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/json_members.hpp"
#include "audit/search/evaluation.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"
#include "core/base/text.hpp"
#include "files/json_text.hpp"

namespace barycert {

using namespace audit;

namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

/// A number in the wording of the file, with its place for the error message.
double number(const Json& at, const std::string& where) {
    const std::optional<double> x = at.is_string()   ? base::parse_double(at.get<std::string>())
                                    : at.is_number() ? std::optional<double>(at.get<double>())
                                                     : std::nullopt;
    if (!x || !std::isfinite(*x))
        refuse(where, "a finite number, best in hexadecimal as in \"0x1.8p+1\"", found_json(at));
    return *x;
}

/// The array of so many entries.
const Json& array_of(const Json& object, const char* key, std::size_t n, const std::string& where) {
    const Json& a = member(object, key, where);
    if (!a.is_array() || a.size() != n)
        refuse(where + ", " + key, "an array of " + std::to_string(n),
               a.is_array() ? std::to_string(a.size()) + " entries" : found_json(a));
    return a;
}

void set_numbers(double* to, const Json& from, const std::string& where) {
    std::ranges::transform(from, to, [&](const Json& j) { return number(j, where); });
}

std::uint64_t count_or(const Json& object, const char* key, std::uint64_t otherwise) {
    return object.contains(key) && object.at(key).is_number_unsigned() ? object.at(key).get<std::uint64_t>()
                                                                       : otherwise;
}

std::string text_of_witnesses(const std::vector<const Witness*>& witnesses) {
    const ExactEnvironment environment;
    Ordered list = Ordered::array();
    for (const Witness* const w : witnesses) list.push_back(witness_json(*w));
    return base::json_text({{"schema", witness_schema}, {"witnesses", std::move(list)}}, 1);
}

Witness witness_from(const Json& j, const std::string& where) {
    Witness w;
    const Json& simplex = member(j, "simplex", where);
    const auto known = simplex.is_string() ? simplex_named(simplex.get<std::string>()) : std::nullopt;
    if (!known) refuse(where, "segment, triangle, triangle3d or tetrahedron as simplex", found_json(simplex));
    w.c.simplex = *known;
    // A new member: without it, as in older files, there is none.
    const Json perspective = j.value("perspective", Json(false));
    if (!perspective.is_boolean() || (perspective.get<bool>() && *known != Simplex::triangle))
        refuse(where + ", perspective", "false, or true for a triangle", found_json(perspective));
    w.c.perspective = perspective.get<bool>();
    for (const auto& [key, text] : {std::pair("kernel", &Witness::kernel),
                                    {"reason", &Witness::reason},
                                    {"family", &Witness::family},
                                    {"mesh", &Witness::mesh},
                                    {"detail", &Witness::detail}}) {
        if (j.contains(key) && j.at(key).is_string()) w.*text = j.at(key).get<std::string>();
    }
    w.seed = count_or(j, "seed", 0);
    w.index = count_or(j, "case", 0);
    if (j.contains("magnitude") && j.at("magnitude").is_number()) w.magnitude = j.at("magnitude").get<double>();
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (const std::uint64_t cell = count_or(j, "cell", most); cell < most) w.cell = static_cast<std::int64_t>(cell);
    const auto n = static_cast<std::size_t>(vertex_count(*known)),
               d = static_cast<std::size_t>(space_dimension(*known)), stride = static_cast<std::size_t>(w.c.stride());
    const Json& vertices = array_of(j, "vertices", n, where);
    for (std::size_t i = 0; i < n; ++i) {
        const std::string vertex = where + ", vertex " + std::to_string(i);
        if (!vertices[i].is_array() || vertices[i].size() != stride)
            refuse(vertex, std::to_string(d) + " coordinates" + (w.c.perspective ? " and w" : ""),
                   vertices[i].dump().substr(0, 80));
        set_numbers(&w.c.vertices[stride * i], vertices[i], vertex);
        if (w.c.perspective && !(w.c.depth(static_cast<int>(i)) > 0))
            refuse(vertex, "a depth w above 0", vertices[i][d].dump());
    }
    set_numbers(w.c.point.data(), array_of(j, "point", d, where), where + ", point");
    if (j.contains("values")) set_numbers(w.c.values.data(), array_of(j, "values", n, where), where + ", values");
    return w;
}

std::string not_reproduced(const Replay& r, const std::vector<Kernel>& kernels) {
    const Witness& w = r.witness;
    if (w.kernel.empty() || w.reason.empty()) return "";
    const std::size_t reason = search_reason_named(w.reason);
    if (reason == search_reasons) return "no class of finding has that name";
    if (std::ranges::find(kernels, w.kernel, &Kernel::name) == kernels.end())
        return "no kernel of that name here; name its library with job.kernel_library";
    const auto a = std::ranges::find(r.answers, w.kernel, &KernelAnswer::kernel);
    if (a == r.answers.end()) return "the kernel is for another simplex";
    if (reason < finding_count) {
        if (a->comparison.counts[reason] != 0) return "";
        return is_incident(reason)
                   ? "asked once more, the kernel did not; it may depend on the cases before, or on chance"
                   : "the kernel's answer does not have this finding";
    }
    // Errors come out the same wherever the kernel was compiled to the same arithmetic.
    const bool relative = reason == witness_reasons;
    const double error = relative                  ? relative_error(r.exact, a->comparison)
                         : reason == finding_count ? a->comparison.worst_weight_ulp()
                                                   : a->comparison.value_ulp;
    if (error == w.magnitude) return "";
    return "the error is " + base::shortest(error) + (relative ? "" : " ulps") + ", not " + base::shortest(w.magnitude);
}

}  // namespace

Ordered audit::witness_json(const Witness& w) {
    const auto list = [](const auto& numbers, int n, std::string (*text)(double)) {
        Ordered out = Ordered::array();
        for (int i = 0; i < n; ++i) out.push_back(text(numbers[static_cast<std::size_t>(i)]));
        return out;
    };
    const auto put_places = [&](Ordered& to, std::string (*text)(double)) {
        Ordered& vertices = to["vertices"] = Ordered::array();
        for (int i = 0; i < vertex_count(w.c.simplex); ++i)
            vertices.push_back(list(&w.c.vertices[static_cast<std::size_t>(i * w.c.stride())], w.c.stride(), text));
        to["point"] = list(w.c.point, space_dimension(w.c.simplex), text);
    };
    Ordered j;
    j["kernel"] = w.kernel;
    j["reason"] = w.reason;
    j["simplex"] = name(w.c.simplex);
    j["perspective"] = w.c.perspective;
    j["family"] = w.family;
    j["seed"] = w.seed;
    j["case"] = w.index;
    j["magnitude"] = std::isfinite(w.magnitude) ? Ordered(w.magnitude) : Ordered(nullptr);
    if (w.cell >= 0) {
        j["mesh"] = w.mesh;
        j["cell"] = w.cell;
    }
    if (!w.detail.empty()) j["detail"] = w.detail;
    put_places(j, base::hexadecimal);
    j["values"] = list(w.c.values, vertex_count(w.c.simplex), base::hexadecimal);
    put_places(j["decimal"], base::shortest);
    return j;
}

std::string witnesses_json(const AuditReport& report) {
    std::vector<const Witness*> all;
    for (const KernelResult& k : report.kernels) {
        for (const Witness& w : k.witnesses) all.push_back(&w);
    }
    return text_of_witnesses(all);
}

std::string witnesses_json(const SearchReport& report) {
    std::vector<const Witness*> all;
    for (const SearchFind& f : report.finds) all.push_back(&f.plain);
    return text_of_witnesses(all);
}

Result<std::vector<Witness>> read_witnesses(const std::string& path) {
    const ExactEnvironment environment;
    const JsonFile file{"cannot read the witnesses", "not a witness file", "witness file",
                        "make one with `barycert audit --witnesses FILE`",
                        "; witnesses are made with `barycert audit --witnesses FILE`"};
    return made_of_json(path, file, [](const Json& all) {
        const Json& list = member(all, "witnesses", "witness file");
        if (!list.is_array()) refuse("witnesses", "an array", found_json(list));
        std::vector<Witness> witnesses;
        for (std::size_t i = 0; i < list.size(); ++i)
            witnesses.push_back(witness_from(list[i], "witness " + std::to_string(i)));
        return witnesses;
    });
}

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
        if (k.simplex != c.simplex || k.perspective != c.perspective) continue;
        const Evaluation e = evaluate(k, c);
        r.answers.push_back({k.name, e.said.answered, e.said.status, e.said.weights, e.comparison, e.detail});
    }
    r.not_reproduced = not_reproduced(r, kernels);
    return r;
}

}  // namespace barycert
