#include "barycert/io/vtk/xml_tree.hpp"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include <algorithm>

#include "barycert/io/vtk/messages.hpp"

namespace barycert::io {
namespace {

constexpr std::string_view appended_tag = "<AppendedData";

/// Collects elements in the order of their opening tags.
class ElementParser : public vtkXMLParser {
public:
    static ElementParser* New();
    ElementParser(const ElementParser&) = delete;
    ElementParser& operator=(const ElementParser&) = delete;

    std::vector<XmlElement> elements;

    /// VTK's interface takes lengths of 32 bits.
    bool parse(std::string_view text) {
        while (!text.empty()) {
            const std::size_t step = std::min(text.size(), std::size_t{1} << 24);
            if (ParseChunk(text.data(), static_cast<unsigned>(step)) == 0) return false;
            text.remove_prefix(step);
        }
        return true;
    }

protected:
    ElementParser() { IgnoreCharacterData = 1; }
    ~ElementParser() override = default;

    void StartElement(const char* name, const char** attributes) override {
        XmlElement element;
        element.name = name;
        element.begin = element.end = static_cast<std::size_t>(GetXMLByteIndex());
        for (; attributes[0] != nullptr; attributes += 2) element.attributes.emplace_back(attributes[0], attributes[1]);
        if (!open_.empty()) elements[open_.back()].children.push_back(elements.size());
        open_.push_back(elements.size());
        elements.push_back(std::move(element));
    }
    void EndElement(const char*) override {
        elements[open_.back()].end = static_cast<std::size_t>(GetXMLByteIndex());
        open_.pop_back();
    }

private:
    std::vector<std::size_t> open_;
};

ElementParser* ElementParser::New() {
    VTK_STANDARD_NEW_BODY(ElementParser);
}

/// Behind the tag that begins at `at`. Values in quotes may hold a closing bracket.
std::size_t behind_tag(std::string_view bytes, std::size_t at) {
    char quote = 0;
    for (; at < bytes.size(); ++at) {
        const char c = bytes[at];
        if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '>') {
            return at + 1;
        }
    }
    return bytes.size();
}

std::string_view up_to_tag(std::string_view text) {
    return text.substr(0, text.find('<'));
}

}  // namespace

std::optional<std::string_view> XmlElement::attribute(std::string_view key) const {
    for (const auto& [name_of, value] : attributes) {
        if (name_of == key) return value;
    }
    return std::nullopt;
}

const XmlElement* XmlTree::child(const XmlElement& of, std::string_view name) const {
    for (const std::size_t i : of.children) {
        if (elements[i].name == name) return &elements[i];
    }
    return nullptr;
}

std::size_t line_of(std::string_view bytes, std::size_t at) {
    return 1 +
           static_cast<std::size_t>(std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string_view text_of(std::string_view bytes, const XmlTree& tree, const XmlElement& element) {
    if (element.end <= element.begin) return {};
    const std::string_view head = up_to_tag(bytes.substr(behind_tag(bytes, element.begin)));
    if (element.children.empty() || head.find_first_not_of(" \t\r\n") != std::string_view::npos) return head;
    const XmlElement& last = tree.elements[element.children.back()];
    const std::size_t behind = behind_tag(bytes, last.end);
    return up_to_tag(bytes.substr(behind, element.end > behind ? element.end - behind : 0));
}

Result<XmlTree> parse_xml(std::string_view bytes, const std::string& path) {
    XmlTree tree;
    Messages messages;
    vtkNew<ElementParser> parser;
    messages.listen_to(parser);
    // Raw appended data are no XML: the document is brought to an end before them.
    const std::size_t appended = bytes.find(appended_tag);
    bool parsed = parser->InitializeParser() != 0;
    if (appended == std::string_view::npos) {
        parsed = parsed && parser->parse(bytes);
    } else {
        const std::size_t data = behind_tag(bytes, appended);
        std::string tag(bytes.substr(appended, data - appended));
        if (tag.ends_with('>')) tag.insert(tag.size() - 1, tag.ends_with("/>") ? "" : "/");
        parsed = parsed && parser->parse(bytes.substr(0, appended)) && parser->parse(tag + "</VTKFile>");
        tree.appended = bytes.substr(data);
        const std::size_t mark = tree.appended.find_first_not_of(" \t\r\n");
        if (mark != std::string_view::npos && tree.appended[mark] == '_') tree.appended.remove_prefix(mark + 1);
    }
    parsed = parser->CleanupParser() != 0 && parsed;
    if (!parsed || parser->elements.empty() || !messages.first().empty()) {
        return Error{.what = "not a well-formed XML file",
                     .file = path,
                     .line = 0,
                     .expected = {},
                     .found = messages.first(),
                     .remedy = "write it again: it may be cut off"};
    }
    tree.elements = std::move(parser->elements);
    if (const XmlElement* const element = tree.child(tree.root(), "AppendedData"); element != nullptr) {
        const std::optional<std::string_view> encoding = element->attribute("encoding");
        tree.appended_raw = encoding == "raw";
        if (encoding.has_value() && encoding != "raw" && encoding != "base64") {
            return Error{.what = "the encoding of the appended data",
                         .file = path,
                         .line = line_of(bytes, element->begin),
                         .expected = "raw or base64",
                         .found = std::string(*encoding)};
        }
    }
    return tree;
}

}  // namespace barycert::io
