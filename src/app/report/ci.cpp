#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/common/json.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "core/base/text.hpp"
#include "draw/picture.hpp"
#include "files/json_text.hpp"

namespace barycert {

using namespace report;
using draw::xml_escaped;

namespace {

using State = CiOutcome::State;

std::string testcase(const CiOutcome& o) {
    const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"0\"",
                                         xml_escaped(o.subject), xml_escaped(o.name));
    if (o.state == State::passed) return head + "/>\n";
    if (o.state == State::noted)
        return fmt::format("{}>\n      <system-out>{}</system-out>\n    </testcase>\n", head, xml_escaped(o.message));
    return fmt::format("{}>\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n    </testcase>\n", head,
                       xml_escaped(o.rule), xml_escaped(o.message), xml_escaped(o.subject + ": " + o.message));
}

std::ptrdiff_t failures(std::span<const CiOutcome> outcomes) {
    return std::ranges::count(outcomes, State::failed, &CiOutcome::state);
}

/// Codes characters that are not plain as %xx.
std::string coded(std::string_view text, auto plain) {
    std::string out;
    for (const char c : text)
        out += plain(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return out;
}

/// A path as a reference that any reader of URIs takes.
std::string uri_of(const std::string& path) {
    return (path.starts_with('/') ? "file://" : "") + coded(path, [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      std::string_view("-._~/").find(c) != std::string_view::npos;
           });
}

/// GitHub's rule for the data of a workflow command; `in_property`: for its properties.
std::string command_data(const std::string& text, bool in_property) {
    return coded(base::printable(text), [&](char c) { return c != '%' && !(in_property && (c == ':' || c == ',')); });
}

}  // namespace

bool CiReport::failed() const {
    return failures(outcomes) != 0;
}

std::string ci_junit(const CiReport& report) {
    const ExactEnvironment environment;
    const std::vector<CiOutcome>& all = report.outcomes;
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out += fmt::format("<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" time=\"{:.3f}\">\n",
                       xml_escaped(report.command), all.size(), failures(all), report.seconds);
    for (std::size_t i = 0; i < all.size();) {
        std::size_t end = i;
        std::string cases;
        for (; end < all.size() && all[end].subject == all[i].subject; ++end) cases += testcase(all[end]);
        out += fmt::format(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"0\">\n{}  "
            "</testsuite>\n",
            xml_escaped(all[i].subject), end - i, failures(std::span(all).subspan(i, end - i)), cases);
        i = end;
    }
    return out + "</testsuites>\n";
}

std::string ci_sarif(const CiReport& report) {
    const ExactEnvironment environment;
    std::vector<std::string> ids;
    Json rules = Json::array(), results = Json::array();
    for (const CiOutcome& o : report.outcomes) {
        if (o.state == State::passed) continue;
        auto at = std::ranges::find(ids, o.rule);
        if (at == ids.end()) {
            rules.push_back(record("id", o.rule, "shortDescription", record("text", o.meaning)));
            at = ids.insert(ids.end(), o.rule);
        }
        Json location;
        if (!o.artifact.empty()) location["physicalLocation"]["artifactLocation"]["uri"] = uri_of(o.artifact);
        put(location, "logicalLocations", Json::array({record("fullyQualifiedName", o.subject, "kind", report.kind)}));
        // The fingerprint stays the same from run to run, so that a system knows a result again.
        results.push_back(record("ruleId", o.rule, "ruleIndex", at - ids.begin(), "level",
                                 o.state == State::failed ? "error" : "note", "message",
                                 record("text", o.subject + ": " + o.message), "locations", Json::array({location}),
                                 "partialFingerprints", record("subjectAndName/v1", o.subject + " " + o.name)));
    }
    const Json driver = record("name", "barycert", "version", report.environment.version, "rules", rules);
    const Json run = record("tool", record("driver", driver), "invocations",
                            Json::array({record("executionSuccessful", true)}), "results", results);
    return base::json_text(record("$schema", "https://json.schemastore.org/sarif-2.1.0.json", "version", "2.1.0",
                                  "runs", Json::array({run})),
                           1);
}

std::string ci_annotations(const CiReport& report) {
    const ExactEnvironment environment;
    std::string out;
    for (const CiOutcome& o : report.outcomes) {
        if (o.state != State::failed) continue;
        out += "::error ";
        if (!o.artifact.empty()) out += "file=" + command_data(o.artifact, true) + ",";
        out += fmt::format("title={}::{}\n", command_data(report.command + ": " + o.subject, true),
                           command_data(o.name + ": " + o.message, false));
    }
    return out;
}

}  // namespace barycert
