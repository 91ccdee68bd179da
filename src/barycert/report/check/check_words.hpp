/// The words that all reports on a mesh share: conditions, counts, places, and sentences about the whole mesh.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/report.hpp"

namespace barycert::report {

/// A condition of the certificate in words, and how often it is violated.
struct ConditionRow {
    std::string_view name;          ///< "P1" ...; empty for what follows from P1 to P4
    std::string_view text;          ///< what holds
    std::uint64_t count = 0;        ///< violations
    bool at_least = false;          ///< there may be more
    std::string_view instead = {};  ///< without violations: "ok", "not provided" or "not checked"
};
std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh);

/// A sentence about cells that took no part in P2 to P5; empty if all did.
std::string_view left_out_sentence(const CheckReport& report);

inline constexpr std::string_view breaking_heading = "Defects and remedies";
inline constexpr std::string_view harmless_heading = "Notes: these do not affect the certificate";

/// "cells 3 and 17, nodes 4 5 6 (coplanar)".
std::string place_text(const CheckReport& report, DefectKind kind, const DefectPlace& place);

/// "overlap", "touch in a point", "touch along a segment" or "touch in an area".
std::string_view meeting_text(const CellContact& contact);

/// A fraction of at most `longest` characters, or its ends and its length. Fractions grow with the widths of
/// coordinates, up to thousands of digits.
std::string shortened_fraction(const std::string& fraction, std::size_t longest);

/// The measures that reports show in another form: |volume|, and the bits of accuracy that the cell's shape may cost.
std::vector<double> cell_sizes(const CellMeasures& measures);
std::vector<double> lost_bits(const CellMeasures& measures);

/// How cells and nodes are numbered, and what the reader of the mesh has told, a line each.
std::string numbering_sentence(const CheckReport& report, const Mesh& mesh);
std::vector<std::string> note_sentences(const CheckReport& report);

/// What was done to a mesh, a line each.
std::vector<std::string> fix_sentences(const FixedMesh& fixed);

/// "1,234,567".
std::string grouped(std::uint64_t n);

/// Sentences with counts, whose digits are grouped by commas or not.
class CheckWords {
public:
    enum class Digits : std::uint8_t { plain, grouped };
    CheckWords(const CheckReport& report, Digits digits) : r_(report), digits_(digits) {}

    std::string number(std::uint64_t n) const;
    std::string counted(std::uint64_t n, std::string_view one, std::string_view more) const;
    std::string count_of(const Defect& defect) const;  ///< "40", or "at least 1000"

    std::string domain() const;     ///< "1 part, 0 cavities, 7 tunnels"; in the plane a cavity is a hole
    std::string certified() const;  ///< "5 cells partition a domain of 1 part, ..."
    std::string proof() const;      ///< what a certificate says
    /// Where a defect may come from: of one with curved cells.
    std::string curved(const Defect& defect) const;
    std::string orientations() const;  ///< how many cells are positive, negative, degenerate
    std::string volumes() const;       ///< both volumes, without whether they are equal
    std::string uncounted() const;     ///< why cavities and tunnels were not counted; empty if they were
    std::string checked() const;       ///< "8 nodes and 5 cells, checked in 0.01 s on 2 threads"

    /// The outcome, then the worst violation if there is one. Requires the report's `delaunay`.
    std::vector<std::string> delaunay() const;
    /// The outcome, then distances, missing nodes and violated facets where there are some, of these at most as many as
    /// fit in `columns`. Requires the report's `conformity`.
    std::vector<std::string> conformity(std::size_t columns) const;

private:
    std::string_view size_word() const { return r_.dimension == 2 ? "area" : "volume"; }

    const CheckReport& r_;
    Digits digits_;
};

}  // namespace barycert::report
