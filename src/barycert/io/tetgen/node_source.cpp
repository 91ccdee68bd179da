// The rows of a .node file, one after the other. The grammar and the words of its errors are those of mesh/: the file
// is mapped, and its pages are let go behind the reader, so that memory does not grow with the file.
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/tetgen/row_errors.hpp"
#include "barycert/io/tetgen/tetgen_reader.hpp"
#include "barycert/io/tetgen/text_table.hpp"

namespace barycert::io {
namespace {

using barycert::io::ColumnKind;
using barycert::io::header_error;
using barycert::io::header_field;
using barycert::io::Scanner;
using barycert::io::TextTable;

/// Large against a page, small against memory.
constexpr std::ptrdiff_t kept_behind = std::ptrdiff_t{1} << 22;

class NodeSource final : public PointSource {
public:
    NodeSource(TextTable table, int dimension) : table_(std::move(table)), dimension_(dimension) {}

    Status begin();

    int dimension() const override { return dimension_; }
    std::optional<std::uint64_t> count() const override { return table_.rows; }
    Result<std::size_t> read(std::size_t max, std::vector<double>& out) override;

private:
    bool parse(Scanner& scanner, std::array<double, 3>& point) const;
    Status check_end() const;
    void let_go();

    TextTable table_;
    int dimension_;
    std::size_t attributes_ = 0;
    bool markers_ = false;
    const char* at_ = nullptr;
    const char* kept_ = nullptr;  // the pages before are let go
    std::size_t row_ = 0;
    Error error_;
};

Status NodeSource::begin() {
    const std::int64_t dimension = header_field(table_, 1, 3);
    const std::int64_t attributes = header_field(table_, 2, 0);
    const std::int64_t markers = header_field(table_, 3, 0);
    if (dimension != dimension_) {
        const std::string asked = std::to_string(dimension_);
        return header_error(table_, "bad dimension in the header",
                            asked + ", for the mesh is " + asked + "-dimensional", std::to_string(dimension),
                            "give points of the dimension of the mesh");
    }
    if (markers > 1) {
        return header_error(table_, "bad number of markers in the header", "0 or 1", std::to_string(markers),
                            "declare further columns as attributes");
    }
    attributes_ = static_cast<std::size_t>(attributes);
    markers_ = markers != 0;
    table_.columns = {{ColumnKind::id, 1, "id"},
                      {ColumnKind::real, static_cast<std::size_t>(dimension), "coordinate"},
                      {ColumnKind::real, attributes_, "attribute"},
                      {ColumnKind::integer, static_cast<std::size_t>(markers), "marker"}};
    table_.surplus_remedy = "mend the header: nodes, dimension, attributes, markers";
    const std::vector<std::string_view> first = table_.first_row();
    std::int64_t id = 0;
    table_.base = !first.empty() && barycert::io::scan_integer(first.front().data(), id) != nullptr && id == 1 ? 1 : 0;
    if (Status room = check_room(table_); !room) return room;
    at_ = table_.body;
    kept_ = table_.begin();
    return table_.rows == 0 ? check_end() : Done{};
}

bool NodeSource::parse(Scanner& scanner, std::array<double, 3>& point) const {
    if (!scan_id(scanner, row_ + static_cast<std::size_t>(table_.base))) return false;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension_); ++axis) {
        if (!scanner.separator() || !scanner.real(point[axis])) return false;
    }
    for (std::size_t i = 0; i < attributes_; ++i) {
        double ignored = 0;
        if (!scanner.separator() || !scanner.real(ignored)) return false;
    }
    std::int64_t marker = 0;
    if (markers_ && (!scanner.separator() || !scanner.integer(marker))) return false;
    return scanner.end_row();
}

Status NodeSource::check_end() const {
    Scanner scanner{at_, table_.end()};
    if (scanner.next_row(table_.end())) return surplus_text(table_, scanner.at);
    return Done{};
}

void NodeSource::let_go() {
    if (at_ - kept_ < kept_behind) return;
    const ::ssize_t page = ::sysconf(_SC_PAGESIZE);
    const std::ptrdiff_t size = (at_ - kept_) / page * page;  // the mapping begins at a page, and so does each part
    // Clean pages of a file come back from it if they are looked at again, as the words of an error need. A failure
    // costs memory and nothing else.
    ::madvise(const_cast<char*>(kept_), static_cast<std::size_t>(size), MADV_DONTNEED);
    kept_ += size;
}

Result<std::size_t> NodeSource::read(std::size_t max, std::vector<double>& out) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    std::size_t taken = 0;
    std::array<double, 3> point{};
    for (; taken != max && row_ != table_.rows; ++taken, ++row_) {
        Scanner scanner{at_, table_.end()};
        const bool begun = scanner.next_row(table_.end());
        if (!begun || !parse(scanner, point)) {
            error_ = begun ? row_error(table_, scanner.at, row_) : too_few_rows(table_, row_);
            return error_;
        }
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension_); ++axis) out.push_back(point[axis]);
        at_ = scanner.at;
        let_go();
    }
    if (taken != 0 && row_ == table_.rows) {
        if (Status end = check_end(); !end) return error_ = end.error();
    }
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_node_source(const std::string& path, int dimension) {
    constexpr std::array names{"nodes", "dimensions", "attributes", "markers"};
    Result<TextTable> table = barycert::io::open_table(path, names);
    if (!table) return table.error();
    auto source = std::make_unique<NodeSource>(std::move(*table), dimension);
    if (Status begun = source->begin(); !begun) return begun.error();
    return std::unique_ptr<PointSource>(std::move(source));
}

}  // namespace barycert::io
