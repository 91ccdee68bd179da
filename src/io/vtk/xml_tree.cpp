#include <expat.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"

namespace barycert::io {
namespace {

constexpr std::string_view appended_tag = "<AppendedData";

class ElementParser {
public:
    ElementParser() : parser_(XML_ParserCreate(nullptr)) {
        if (parser_ == nullptr) throw std::bad_alloc();
        XML_SetUserData(parser_, this);
        XML_SetElementHandler(parser_, start, end);
        XML_SetStartDoctypeDeclHandler(parser_, doctype);
    }
    ~ElementParser() { XML_ParserFree(parser_); }
    ElementParser(const ElementParser&) = delete;
    ElementParser& operator=(const ElementParser&) = delete;

    std::vector<XmlElement> elements;
    bool at_appended_data = false, has_doctype = false, out_of_memory = false;

    /// Bytes `first` to `last` - 1 of the file; text between tags may be left out. False: an error, or appended data.
    bool parse(std::string_view file, std::size_t first, std::size_t last) {
        jumps_.push_back({fed_, first});
        constexpr std::size_t chunk = std::size_t{1} << 24;  // expat takes lengths of 31 bits
        for (std::size_t at = first; at < last; at += chunk) {
            const std::size_t size = std::min(chunk, last - at);
            fed_ += size;
            if (XML_Parse(parser_, file.data() + at, static_cast<int>(size), XML_FALSE) != XML_STATUS_OK) return false;
        }
        return true;
    }
    bool finish() { return XML_Parse(parser_, nullptr, 0, XML_TRUE) == XML_STATUS_OK; }

    XML_Error fault() const { return XML_GetErrorCode(parser_); }
    std::size_t place() const {
        const auto index = static_cast<std::size_t>(std::max<XML_Index>(XML_GetCurrentByteIndex(parser_), 0));
        const auto behind = std::ranges::upper_bound(jumps_, index, {}, &Jump::fed);
        return behind == jumps_.begin() ? index : index - (behind - 1)->fed + (behind - 1)->place;
    }

private:
    struct Jump {
        std::size_t fed, place;  // the byte that expat counts so, and where it stands in the file
    };

    static void XMLCALL start(void* data, const XML_Char* name, const XML_Char** attributes) {
        auto& self = *static_cast<ElementParser*>(data);
        try {
            XmlElement element;
            element.name = name;
            element.begin = element.end = self.place();
            for (; attributes[0] != nullptr; attributes += 2)
                element.attributes.emplace_back(attributes[0], attributes[1]);
            if (!self.open_.empty()) self.elements[self.open_.back()].children.push_back(self.elements.size());
            self.at_appended_data = element.name == "AppendedData" && self.open_.size() == 1;
            self.open_.push_back(self.elements.size());
            self.elements.push_back(std::move(element));
        } catch (const std::bad_alloc&) {  // no exception may pass through expat
            self.out_of_memory = true;
        }
        if (self.at_appended_data || self.out_of_memory) XML_StopParser(self.parser_, XML_FALSE);
    }
    static void XMLCALL end(void* data, const XML_Char*) {
        auto& self = *static_cast<ElementParser*>(data);
        if (self.at_appended_data || self.out_of_memory) return;
        self.elements[self.open_.back()].end = self.place();
        self.open_.pop_back();
    }
    static void XMLCALL doctype(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
        static_cast<ElementParser*>(data)->has_doctype = true;
        XML_StopParser(static_cast<ElementParser*>(data)->parser_, XML_FALSE);
    }

    XML_Parser parser_;
    std::vector<std::size_t> open_;
    std::vector<Jump> jumps_;
    std::size_t fed_ = 0;
};

/// Behind the tag that begins at `at`. Values in quotes may hold a closing bracket.
std::size_t behind_tag(std::string_view bytes, std::size_t at) {
    while ((at = bytes.find_first_of("\"'>", at)) != std::string_view::npos) {
        if (bytes[at] == '>') return at + 1;
        at = std::min(bytes.find(bytes[at], at + 1), bytes.size() - 1) + 1;
    }
    return bytes.size();
}

/// Hands the file to the parser up to appended data, without the long texts between tags: numbers, which XML does not
/// concern. They are found by their first and last bytes, many times faster than expat reads them. False where it ends.
bool parse_tags(std::string_view bytes, ElementParser& parser) {
    constexpr std::size_t long_text = std::size_t{1} << 14;
    const auto find_tag = [&](std::size_t from) { return std::min(bytes.find('<', from), bytes.size()); };
    std::size_t first = 0;  // not yet handed over
    for (std::size_t tag = find_tag(0), next; tag < bytes.size(); tag = next) {
        if (bytes.substr(tag, appended_tag.size()) == appended_tag) {
            // Hands over the tag alone: anything may follow it.
            const std::size_t behind = behind_tag(bytes, tag);
            if (!parser.parse(bytes, first, behind)) return false;
            first = behind;
            next = find_tag(behind);
            continue;
        }
        next = find_tag(tag + 1);
        const char kind = tag + 1 < bytes.size() ? bytes[tag + 1] : '!';
        // Comments and the like are no elements, and all their text counts.
        if (next - tag <= long_text || kind == '!' || kind == '?') continue;
        const std::size_t text = behind_tag(bytes.substr(0, next), tag);
        if (next - text <= long_text || bytes[text - 1] != '>') continue;
        if (!parser.parse(bytes, first, text)) return false;
        first = next;
    }
    return parser.parse(bytes, first, bytes.size()) && parser.finish();
}

}  // namespace

std::optional<std::string_view> XmlElement::attribute(std::string_view key) const {
    const auto found = std::ranges::find(attributes, key, &std::pair<std::string, std::string>::first);
    if (found == attributes.end()) return std::nullopt;
    return found->second;
}

const XmlElement* XmlTree::child(const XmlElement* of, std::string_view name, std::string_view key) const {
    if (of == nullptr) return nullptr;
    const auto found = std::ranges::find_if(of->children, [&](std::size_t i) {
        return key.empty() ? elements[i].name == name : elements[i].attribute(key) == name;
    });
    return found == of->children.end() ? nullptr : &elements[*found];
}

std::string_view XmlTree::text_of(const XmlElement& element) const {
    if (element.end <= element.begin) return {};
    const auto up_to_tag = [](std::string_view text) { return text.substr(0, text.find('<')); };
    const std::string_view head = up_to_tag(bytes.substr(behind_tag(bytes, element.begin)));
    if (element.children.empty() || head.find_first_not_of(" \t\r\n") != std::string_view::npos) return head;
    const std::size_t behind = behind_tag(bytes, elements[element.children.back()].end);
    return up_to_tag(bytes.substr(behind, element.end > behind ? element.end - behind : 0));
}

XmlTree parse_xml(std::string_view bytes, const std::string& path) {
    XmlTree tree{{bytes, path}, {}, {}};
    ElementParser parser;
    const bool whole = parse_tags(bytes, parser);
    if (parser.out_of_memory || parser.fault() == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    const char* const place = bytes.data() + parser.place();
    if (parser.has_doctype)
        tree.refuse("file.unsupported", place, "a document type in an XML file of VTK",
                    "none: entities that it defines could grow without bound", "<!DOCTYPE", "remove it");
    if (!whole && !parser.at_appended_data)
        tree.refuse("file.syntax", place, "not a well-formed XML file", "", XML_ErrorString(parser.fault()), cut_off);
    tree.elements = std::move(parser.elements);
    if (!parser.at_appended_data) return tree;
    const XmlElement& element = tree.elements.back();
    tree.appended = bytes.substr(behind_tag(bytes, element.begin));
    const std::size_t mark = tree.appended.find_first_not_of(" \t\r\n");
    if (mark != std::string_view::npos && tree.appended[mark] == '_') tree.appended.remove_prefix(mark + 1);
    const std::optional<std::string_view> encoding = element.attribute("encoding");
    tree.appended_raw = encoding == "raw";
    if (encoding && encoding != "raw" && encoding != "base64")
        tree.refuse_at("file.unsupported", element, "the encoding of the appended data", "raw or base64",
                       std::string(*encoding));
    return tree;
}

}  // namespace barycert::io
