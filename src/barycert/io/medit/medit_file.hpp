/// Medit's files (the Gamma mesh format), text and binary: what sections there are, and the numbers in them.
///
/// text    MeshVersionFormatted VERSION, then keywords with what belongs to them, words parted by white space;
///         # starts a comment that goes to the end of the line. Vertices, cells: COUNT, rows. SolAt...: COUNT, the
///         number of fields, the type of each, rows. The last keyword is End, which may be missing.
/// binary  1 (whose bytes tell their order), version; then keyword, place of the next keyword, data, as above, up to
///         the keyword End. All are int32; places are int64 from version 3 on, counts and indices in version 4; real
///         numbers are float32 in version 1, else float64.
#pragma once

#include "barycert/io/formats.hpp"

namespace barycert::io {

enum class MeditKind : std::uint8_t {
    other,
    vertices,
    cells,
    solution,  ///< fields of nodes (dimension 0), triangles (2) or tetrahedra (3)
};

struct MeditKeyword {
    int code;  ///< in binary files
    std::string_view name;
    MeditKind kind = MeditKind::other;
    int dimension = 0;
    std::size_t nodes = 0;  ///< of a cell
};

struct MeditSection {
    MeditKeyword keyword;
    std::string name = {};                 ///< as in the file
    std::size_t count = 0;                 ///< of rows; 0 where the keyword is not known
    std::vector<std::int64_t> types = {};  ///< of the fields of a solution
    std::string_view body = {};            ///< the rows
};

/// The numbers of a section, row after row: some real ones and then some integers.
struct MeditRows {
    std::size_t reals_a_row = 0, integers_a_row = 0;
    std::vector<double> reals;  ///< any, infinities and NaN included
    std::vector<std::int64_t> integers;
};

/// Errors are thrown as Exceptions, which read_guarded() makes a Result.
class MeditFile {
public:
    /// Error: no file of Medit; a section that does not end within it; two of one kind; another dimension than 2 or 3.
    explicit MeditFile(const std::string& path);

    const std::string& path() const { return path_; }
    int dimension() const { return static_cast<int>(dimension_); }
    bool narrow() const { return binary_ && version_ == 1; }  ///< real numbers are float32
    const std::vector<MeditSection>& sections() const { return sections_; }

    /// Error: fewer numbers or more, or others. Memory is bounded by a multiple of the file's size.
    MeditRows rows(const MeditSection& section, std::size_t reals_a_row, std::size_t integers_a_row) const;

    [[noreturn]] void refuse_in(const MeditSection& section, const MeditRows& rows, std::size_t row, std::size_t column,
                                std::string expected, std::string found, std::string remedy = {}) const;

private:
    void list_text();
    void list_binary();
    void add(std::string name, const MeditKeyword* keyword, std::string_view body);
    void set_header(std::int64_t& number, std::string_view text, std::int64_t least, std::int64_t most);
    std::int64_t take_count(std::string_view& text, std::size_t bytes, const char* what, std::int64_t least,
                            std::int64_t most) const;
    MeditRows text_rows(const MeditSection& section, std::size_t reals, std::size_t integers) const;
    std::size_t real_bytes() const { return version_ == 1 ? 4 : 8; }
    std::size_t integer_bytes() const { return version_ == 4 ? 8 : 4; }
    std::size_t line_at(const char* at) const { return binary_ ? 0 : line_of(bytes_, at); }
    template <class... Parts>
    [[noreturn]] void refuse(const char* at, std::string what, Parts&&... parts) const {
        if (binary_) what += ", at byte " + std::to_string(at - bytes_.data());
        refuse_line(path_, line_at(at), std::move(what), std::forward<Parts>(parts)...);
    }

    std::string path_;
    base::MappedFile data_;
    std::vector<char> uncommented_;  ///< the text, with blanks for comments, if it has any
    std::string_view bytes_;
    bool binary_ = false, swapped_ = false;
    std::int64_t version_ = 0, dimension_ = 0;
    std::vector<MeditSection> sections_;
};

/// By the first bytes of a file, behind a byte-order mark.
bool is_medit(std::string_view head);

/// Reads .mesh and .meshb of version 1 to 4.
///
/// - Tetrahedra make a mesh of dimension 3, and its Triangles are the faces, with their references as markers. Where
///   there are no cells of dimension 3, triangles make one of dimension 2; then z is 0, if there is one. If all are of
///   order 2 (TetrahedraP2, TrianglesP2), their mid-edge nodes are told by the points.
/// - Hexahedra, Prisms, Pyramids, Quadrilaterals, and cells of several sections or of a higher order are taken by their
///   corners and cut into simplices; cells count on from section to section.
/// - References of nodes are point markers, those of cells the cell field "medit:ref"; absent where all are 0.
/// - SolAt... are fields, as in read_medit_fields.
/// - What else there is is left out, with a Note.
///
/// Error: what the format does not have; a coordinate that is not finite; a node that there is not; no cells; polygons
/// off the plane z = 0.
Result<Mesh> read_medit(const std::string& path, const ReadOptions& options, InSpace* space = nullptr);

/// The fields of .sol and .solb files for a mesh of that dimension, and notes, in a mesh without nodes and cells: those
/// of nodes, and those of triangles or tetrahedra, are solution0, solution1, ... each.
Result<Mesh> read_medit_fields(const std::string& path, int dimension);

}  // namespace barycert::io
