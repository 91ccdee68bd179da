/// A report, filled once by its job: what people read, block by block, and what programs read. Writers know no job.
///
/// Text is plain text as it came, from wherever: the writer for a terminal makes it printable, that for a page escapes
/// it. Pages ask for nothing from anywhere, and their head forbids it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "draw/picture.hpp"  // IWYU pragma: keep
#include "files/json_text.hpp"

namespace barycert::report {

using namespace draw;

/// A name of words and dots: escaped, and where lines are short broken behind dots, not within words.
std::string html_name(std::string_view name);

enum class Tone : std::uint8_t { plain, good, bad, strong, soft };

/// Whom a block is for.
enum class For : std::uint8_t { all, terminal, page };

/// The first thing to read. On a terminal one line, with as many reasons as fit; a page has all of them.
struct Headline {
    Tone tone = Tone::plain;
    std::string subject = {};                 ///< what it is said of; may be empty
    std::string text = {};                    ///< "certified"
    std::vector<std::string> reasons = {};    ///< "2 cells are degenerate"
    std::vector<std::string> sentences = {};  ///< below it
};

/// A heading, above it room; on a terminal, which has the more on a screen, it may be that room alone.
struct Section {
    std::string title = {};
    int level = 2;
    bool on_terminal = true;
};

/// How a sentence longer than a terminal's line is broken: not; at blanks; behind commas, as names of files may
/// have blanks.
enum class Breaks : std::uint8_t { none, words, commas };

struct Paragraph {
    std::string text;
    Tone tone = Tone::plain;
    Breaks wrap = Breaks::none;
};

/// A figure, or a few, and what it is called.
struct Named {
    std::string name = {};
    std::vector<std::string> lines = {};
    Tone tone = Tone::plain;
    bool command = false;  ///< to be copied
    Breaks wrap = Breaks::none;
};

struct Column {
    std::string head = {};  ///< on a terminal; line feeds between its lines
    bool left = false;      ///< text, not figures
    std::size_t width = 0;  ///< on a terminal: at least so many characters
    std::size_t gap = 1;    ///< likewise: blanks before it
    std::string page = {};  ///< its head on a page, where that is another one
    std::string tip = {};   ///< more of it, on a page
    For whom = For::all;
};

/// Columns of text, and of figures.
inline Column left(std::string head, std::size_t width = 0, std::size_t gap = 1) {
    return {std::move(head), true, width, gap};
}
inline Column right(std::string head, std::size_t width = 0, std::string page = {}, For whom = For::all) {
    return {.head = std::move(head), .width = width, .page = std::move(page), .whom = whom};
}

struct Cell {
    Cell(std::string shown, std::optional<double> key = {}, Tone in = Tone::plain)  // NOLINT: text is a cell
        : text(std::move(shown)), order(key), tone(in) {}
    std::string text;
    std::optional<double> order;  ///< what a page's rows are sorted by; none: the text
    Tone tone;
};

struct Row {
    std::vector<Cell> cells = {};
    Tone tone = Tone::plain;
    std::vector<std::string> below = {};  ///< on a terminal: lines below it
    std::string tip = {};                 ///< of its first cell, on a page
};

struct Listing {
    std::vector<Column> columns = {};
    std::vector<Row> rows = {};
    /// On a page: `sorts` by a click on a head, and scrolls where the screen is narrow, as figures are compared down
    /// the columns; else rows become lists there.
    bool sorts = false;
    std::string_view style = {};  ///< a page's class
    bool headless = false;        ///< on a terminal
};

/// Something found: a title, and lines about it.
struct Item {
    /// The first of so many places; a page has fewer of them.
    struct Places {
        std::vector<std::string> shown = {};
        std::uint64_t count = 0;
        bool at_least = false;
        char between = ';';
        /// "and 30 more"; empty if all are told.
        std::string more(std::size_t told) const {
            if (told == 0 || told >= count) return "";
            return at_least ? "and more" : fmt::format("and {} more", count - told);
        }
    };
    struct Line {
        std::string text = {};  ///< none is shown if it is empty
        bool command = false;   ///< to be copied
        Places places = {};     ///< below the text
    };
    std::string title = {};
    std::string text = {};  ///< in the title's line
    std::vector<Line> lines = {};
    bool folds = false;      ///< on a page: one of many, shown on a click
    std::size_t indent = 4;  ///< of lines, on a terminal
};

/// Markup of a page, such as pictures: made when the page is written.
using Pictures = std::function<std::string()>;

class Document {  // NOLINT(bugprone-exception-escape): to move Json does not throw
public:
    std::string title = {}, heading = {};  ///< of a page; `heading` is what stands first on it
    std::string footer = {};               ///< of a page
    bool script = false;                   ///< a page's tables sort, its commands are copied
    std::string_view style = {};           ///< a page's, after the common one
    Json data = {};

    using Content = std::variant<Headline, Section, Paragraph, Named, Listing, Item, Pictures>;
    struct Passage {
        Content content;
        For whom;
    };
    std::vector<Passage> blocks = {};

    void add(Content content, For whom = For::all) { blocks.push_back({std::move(content), whom}); }
    /// All that `part` says.
    void append(Document part, For whom) {
        for (Passage& block : part.blocks) add(std::move(block.content), whom);
    }
    void section(std::string text, For whom = For::all, int level = 2) { add(Section{std::move(text), level}, whom); }
    /// With a heading on a page alone.
    void part(std::string text = {}) { add(Section{std::move(text), 2, false}); }
    void say(std::string text, Tone tone = Tone::plain, For whom = For::all, Breaks wrap = Breaks::none) {
        add(Paragraph{std::move(text), tone, wrap}, whom);
    }
    /// With a heading on a page alone.
    void table(Listing listing, std::string title = {}) {
        part(std::move(title));
        add(std::move(listing));
    }
    /// Below a table, what its words mean; already broken into lines.
    void notes(std::initializer_list<std::string> lines) {
        for (const std::string& line : lines) say(line, Tone::soft);
    }
    void name(std::string name, std::string text, Tone tone = Tone::plain) {
        add(Named{std::move(name), {std::move(text)}, tone});
    }

    /// Adds, before all else, how a mesh with curved sides was taken; nothing if its sides are straight. `mesh`: which
    /// of several.
    void curved(const CurvedCells& curved, const std::string& mesh = {});
    /// A member of the data, and what people are told of it.
    void figure(std::string_view key, Json value, std::string name, std::string text, Tone tone = Tone::plain) {
        data[std::string(key)] = std::move(value);
        this->name(std::move(name), std::move(text), tone);
    }
};

/// For a terminal or a log: at most 100 columns, where words allow it.
std::string terminal_text(const Document& document, bool colour);

/// One page of HTML, self-contained and well-formed XML, for screens of any width, light and dark, and for paper.
std::string page_text(const Document& document);

// Results of public functions: a document that fill() makes, as text, JSON and page. All in the exact environment.

template <class Fill>
std::string written_text(const Fill& fill, bool colour) {
    const ExactEnvironment environment;
    return terminal_text(fill(), colour);
}

/// Lists and records of up to `indent` levels begin lines, as json_text() has them.
template <class Fill>
std::string written_json(const Fill& fill, int indent) {
    const ExactEnvironment environment;
    return base::json_text(fill().data, indent);
}

template <class Fill>
std::string written_page(const Fill& fill) {
    const ExactEnvironment environment;
    return page_text(fill());
}

/// For sentences that hold of straight sides alone; empty where these are the mesh's own.
inline std::string_view for_straight_sides(const CurvedCells& curved) {
    return (curved.cells == 0 || curved.mapped) && curved.by_corners == 0 ? "" : " for straight sides";
}

/// "2 s on 4 threads: mesh 0.5, sampling 1.5".
inline std::string time_text(double total, int threads, const std::vector<std::pair<std::string_view, double>>& parts) {
    return fmt::format("{:.3g} s on {}: {}", total, counted(static_cast<std::uint64_t>(threads), "thread"),
                       joined(parts, ", ", [](const auto& p) { return fmt::format("{} {:.3g}", p.first, p.second); }));
}

/// "field T: 3 of 50 values are not finite".
inline std::string not_finite_text(const NotFinite& f) {
    return fmt::format("field {}{}: {} of {} values {} not finite", f.field, f.of_cells ? " of cells" : "", f.count,
                       f.values, f.count == 1 ? "is" : "are");
}

}  // namespace barycert::report
