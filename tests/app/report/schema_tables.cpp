#include "schema_tables.hpp"

#include <cctype>
#include <fstream>
#include <regex>

#include "core/base/text.hpp"

namespace barycert::report_test {
namespace {

bool ends_with(std::string& text, const std::string& ending) {
    if (text.size() < ending.size() || text.substr(text.size() - ending.size()) != ending) return false;
    text.resize(text.size() - ending.size());
    return true;
}

/// True for a string that is a double, in hexadecimal or in decimal as told.
bool is_double(const nlohmann::json& value, bool hex) {
    if (!value.is_string()) return false;
    const std::string text = value.get<std::string>();
    const auto x = base::parse_double(text);
    return x && text == (hex ? base::hexadecimal(*x) : base::shortest(*x));
}

}  // namespace

Schema::Schema(const std::string& path) {
    std::ifstream in(path);
    const std::regex heading("## (\\w+)"), row("\\| `(\\w+)` \\| (.+?) \\| (.+) \\|"),
        parent("[Aa]ll members of (\\w+)");
    std::string section;
    for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (std::regex_match(line, match, heading)) {
            section = match[1];
        } else if (std::regex_match(line, match, row)) {
            Member member{match[2], false, false};
            if (const auto bracket = member.type.find(" (only "); bracket != std::string::npos) {
                member.optional = true;
                member.type.resize(bracket);
            }
            member.nullable = ends_with(member.type, " or null");
            if (!sections_[section].emplace(match[1], member).second)
                complaints.push_back(section + " documents twice " + match[1].str());
        } else if (!section.empty()) {
            for (std::sregex_iterator it(line.begin(), line.end(), parent), end; it != end; ++it)
                parents_[section].push_back((*it)[1]);
        }
    }
    for (const auto& [child, names] : parents_) {
        for (const std::string& name : names) {
            for (const auto& [key, member] : sections_[name]) sections_[child].emplace(key, member);
        }
    }
}

void Schema::check(const std::string& section, const nlohmann::json& value, const std::string& where) {
    if (!sections_.contains(section) || !value.is_object()) {
        complaints.push_back(where + " is no " + section);
        return;
    }
    const auto& members = sections_.at(section);
    for (const auto& [key, member] : members) {
        if (!member.optional && !value.contains(key)) complaints.push_back(where + " has no " + key);
    }
    for (const auto& [key, inner] : value.items()) {
        const std::string name = section + "." + key;
        const auto member = members.find(key);
        if (member == members.end()) {
            complaints.push_back(where + "." + key + " is not documented in " + section);
            continue;
        }
        seen.insert(name);
        (inner.is_null() ? seen_null : seen_value).insert(name);
        if (!(inner.is_null() && member->second.nullable)) check_type(member->second.type, inner, where + "." + key);
    }
}

void Schema::check_type(const std::string& type, const nlohmann::json& value, const std::string& where) {
    const auto complain_unless = [&](bool ok) {
        if (!ok) complaints.push_back(where + " is no " + type + ": " + value.dump().substr(0, 60));
    };
    if (type.starts_with("list of ")) {
        complain_unless(value.is_array());
        std::string item = type.substr(8);
        if (item.starts_with("lists of ")) item = "list of " + item.substr(9);
        if (value.is_array()) {
            for (const auto& inner : value) check_type(item, inner, where + "[]");
        }
    } else if (std::isupper(static_cast<unsigned char>(type.front())) != 0) {
        check(type, value, where);
    } else if (type == "integer") {
        complain_unless(value.is_number_unsigned());
    } else if (type == "number") {
        complain_unless(value.is_number());
    } else if (type == "string") {
        complain_unless(value.is_string());
    } else if (type == "boolean") {
        complain_unless(value.is_boolean());
    } else if (type == "hex" || type == "decimal") {
        complain_unless(is_double(value, type == "hex"));
    } else {
        complaints.push_back(where + ": unknown type " + type);
    }
}

std::set<std::string> Schema::documented() const {
    std::set<std::string> names;
    for (const auto& [section, members] : sections_) {
        for (const auto& [key, member] : members) names.insert(section + "." + key);
    }
    return names;
}

std::set<std::string> Schema::nullable() const {
    std::set<std::string> names;
    for (const auto& [section, members] : sections_) {
        for (const auto& [key, member] : members) {
            if (member.nullable) names.insert(section + "." + key);
        }
    }
    return names;
}

}  // namespace barycert::report_test
