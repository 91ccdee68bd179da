/// doc/json.md read as what it is: one table of members a section, and sections that take over others' members.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace barycert::report_test {

struct Member {
    std::string type;       ///< "integer", "list of Witness", ... without what follows
    bool nullable = false;  ///< "... or null"
    bool optional = false;  ///< "... (only ...)"
};

class Schema {
public:
    explicit Schema(const std::string& path);

    /// Walks a value that a section describes; what does not agree is added to `complaints`, with its place.
    void check(const std::string& section, const nlohmann::json& value, const std::string& where);

    std::vector<std::string> complaints;

    /// "Section.member" of all there are, and of those met so far; with a null, with something else.
    std::set<std::string> documented() const;
    std::set<std::string> seen, seen_null, seen_value;
    std::set<std::string> nullable() const;

private:
    void check_type(const std::string& type, const nlohmann::json& value, const std::string& where);
    std::map<std::string, std::map<std::string, Member>> sections_;
    std::map<std::string, std::vector<std::string>> parents_;
};

}  // namespace barycert::report_test
