// Points from CSV: lines are read by the megabyte, cut into pieces at line ends and parsed on all threads. Pieces are
// looked at in their order, so points and errors do not depend on the number of threads.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "io/csv/csv_layout.hpp"
#include "io/csv/csv_rows.hpp"
#include "io/csv/line_reader.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "mesh/columns.hpp"

namespace barycert::io {
namespace {

/// Text that one thread parses at a time: some hundred microseconds of work.
constexpr std::size_t text_a_piece = std::size_t{1} << 16;

class CsvSource final : public ColumnSource {
public:
    /// Reads up to the header or over the first point. `kept`, `more`: formats and notes of carried columns, if known.
    CsvSource(const std::string& path, int dimension, const PointOptions& options,
              const std::vector<ColumnFormat>& kept = {}, const Notes& more = {})
        : ColumnSource(dimension), lines_(path) {
        for (std::string_view line; lines_.next(line);) {
            if (!holds_fields(line, ' ')) continue;
            layout_ = settle_csv_layout(line, dimension, options, {lines_.name(), lines_.number()});
            if (kept.size() == layout_.kept.size()) layout_.kept = kept;
            formats_ = layout_.kept;
            notes_ = layout_.notes;
            notes_.insert(notes_.end(), more.begin(), more.end());
            if (layout_.header) return;
            // The first point; it is given like all others.
            const std::string text = std::string(line) + (lines_.line_ended() ? "\n" : "");
            pieces_.resize(1);
            parse_csv(text, layout_, dimension, pieces_.front());
            if (pieces_.front().fault) throw Exception(row_error(*pieces_.front().fault));
            piece_count_ = 1;
            return;
        }
        refuse_file("file.empty", lines_.name(), "the file is empty", "a header line or a point",
                    lines_.number() == 0 ? "nothing" : "blank lines and comments",
                    "write the file again; a file with a header only is a file without points");
    }

    std::optional<std::uint64_t> count() const override { return std::nullopt; }

private:
    std::size_t next(std::size_t max, std::vector<double>& out) override {
        const std::size_t size = dimension_;
        std::size_t taken = 0;
        while (taken != max) {
            if (piece_ == piece_count_) {
                if (pending_) throw Exception(*pending_);
                if (!parse_more()) break;
                continue;
            }
            const std::vector<double>& points = pieces_[piece_].points;
            const std::size_t count = std::min(max - taken, points.size() / size - given_);
            out.insert(out.end(), points.data() + given_ * size, points.data() + (given_ + count) * size);
            for (std::size_t k = 0; k < carried_.size(); ++k)
                mesh::move_values(pieces_[piece_].carried[k], given_, count, carried_[k]);
            taken += count;
            given_ += count;
            if (given_ * size != points.size()) continue;
            ++piece_;
            given_ = 0;
        }
        return taken;
    }

    /// Parses the next pieces; false at the end of the file. The error of a line is kept. Requires: all are given.
    bool parse_more() {
        piece_ = piece_count_ = given_ = 0;
        std::string_view text;
        if (!lines_.next_lines(text)) return false;
        texts_.clear();
        while (!text.empty()) {
            std::size_t size = text.size();
            if (size > text_a_piece) size = std::min(text.find('\n', text_a_piece - 1), text.size() - 1) + 1;
            texts_.push_back(text.substr(0, size));
            text.remove_prefix(size);
        }
        piece_count_ = texts_.size();
        if (pieces_.size() < piece_count_) pieces_.resize(piece_count_);
        in_parallel(piece_count_, [&](std::size_t i) { parse_csv(texts_[i], layout_, dimension(), pieces_[i]); });
        for (std::size_t i = 0; i < piece_count_; ++i) {
            lines_.count(pieces_[i].lines);
            if (!pieces_[i].fault) continue;
            pending_ = row_error(*pieces_[i].fault);
            piece_count_ = i + 1;
        }
        return true;
    }

    /// The bad line has been counted.
    Error row_error(Error fault) const {
        if (const Status same = lines_.unchanged(); !same) return same.error();
        fault.file = lines_.name();
        fault.line = lines_.number();
        return fault;
    }

    LineReader lines_;
    CsvLayout layout_;
    std::vector<std::string_view> texts_;
    std::vector<CsvPiece> pieces_;  // those from `piece_` on have points to give, the first of them from `given_` on
    std::size_t piece_ = 0, piece_count_ = 0, given_ = 0;
    std::optional<Error> pending_;  // behind the points that are left
};

/// The formats of the carried columns, from all their values: a first pass over the file.
std::vector<ColumnFormat> formats_of_all(CsvSource source, const std::string& path, Notes& notes) {
    constexpr std::size_t block = std::size_t{1} << 15;
    std::vector<ColumnFormat> formats = source.carried();
    std::vector<TypeOfTexts> types(formats.size());
    std::vector<bool> utf8(formats.size(), true);
    std::vector<double> points;
    std::vector<Column> columns;
    while (true) {
        points.clear();
        if (source.read(block, points).value() == 0) break;
        source.take_carried(columns);
        for (std::size_t k = 0; k < formats.size(); ++k) {
            for (const std::string& text : std::get<std::vector<std::string>>(columns[k].values)) types[k].see(text);
            const ColumnFormat some = mesh::format_of(columns[k]);
            formats[k].max_bytes = std::max(formats[k].max_bytes, some.max_bytes);
            formats[k].max_characters = std::max(formats[k].max_characters, some.max_characters);
            utf8[k] = utf8[k] && some.max_characters != 0;
        }
    }
    for (std::size_t k = 0; k < formats.size(); ++k) {
        formats[k].type = types[k].type();
        if (!utf8[k]) formats[k].max_characters = 0;
        if (formats[k].type != Column::Type::text) formats[k] = {formats[k].name, formats[k].type};
        const auto note = [&](bool told, const std::string& what, const char* to) {
            if (told && formats[k].type == Column::Type::number)
                notes.push_back({Note::Kind::converted, what + " of column " + formats[k].name + to, path});
        };
        note(types[k].empty, "empty fields", " to NaN");
        note(types[k].lost, "numbers", " that are too small for a double to 0");
        note(types[k].rounded, "numbers", " that no double holds to the nearest doubles");
    }
    return formats;
}

}  // namespace

std::unique_ptr<PointSource> open_csv_source(const std::string& path, int dimension, const PointOptions& options) {
    if (!options.typed || options.keep.empty()) return std::make_unique<CsvSource>(path, dimension, options);
    if (is_read_once(path))
        refuse_file("file.pipe", path == "-" ? "standard input" : path,
                    "the types of columns cannot be found in a stream", "a regular file, which can be read twice",
                    "a pipe or device",
                    "write CSV, which carries columns as they are, or save the points to a file first");
    Notes notes;
    const std::vector<ColumnFormat> formats = formats_of_all(CsvSource(path, dimension, options), path, notes);
    return std::make_unique<CsvSource>(path, dimension, options, formats, notes);
}

}  // namespace barycert::io
