#include "mesh/pieces/distribution.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/pieces/exchange.hpp"
#include "mesh/pieces/piece.hpp"

namespace barycert::pieces {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ArrayKind, name, named, type, type_name, components, role, component_names)

namespace {

constexpr std::size_t fine = 64;  ///< boxes of a piece that is asked much

const ArrayKind* find(const std::vector<ArrayKind>& kinds, const ArrayKind& like) {
    for (const ArrayKind& kind : kinds)
        if (kind.named == like.named && (kind.named ? kind.name == like.name : kind.role == like.role)) return &kind;
    return nullptr;
}

// Says what differs; empty if nothing does.
std::string difference(const std::vector<ArrayKind>& mine, const std::vector<ArrayKind>& theirs) {
    for (const ArrayKind& kind : theirs) {
        const ArrayKind* const own = find(mine, kind);
        if (own == nullptr) return kind.text() + " is missing here";
        if (own->type != kind.type || own->components != kind.components)
            return kind.text() + " is here " + own->text();
    }
    for (const ArrayKind& kind : mine)
        if (find(theirs, kind) == nullptr) return kind.text() + " is here only";
    return {};
}

}  // namespace

Box Distribution::box_at(std::size_t point) const {
    std::array<double, 3> x{};
    points_.at(point, x.data());
    return all_finite(x) ? Box{x, x} : empty_box;
}

Status Distribution::gather() {
    RankBoxes mine;
    Status read = exchange_.everywhere([&] {
        mine.cell_count = static_cast<double>(piece_.mesh.cell_count());
        mine.point_count = static_cast<double>(points_.count);
        for (std::size_t i = 0; i < piece_.mesh.whole_count(); ++i) mine.cells.add(piece_.box_of(i));
        for (std::size_t i = 0; i < points_.count; ++i) mine.points.add(box_at(i));
        parts_.resize(static_cast<std::size_t>(exchange_.size()));
    });
    if (!read) return read;
    exchange_.gather(mine, parts_);
    return exchange_.everywhere([&] {
        std::vector<int> partners;
        const int rank = exchange_.rank();
        for (int other = 0; other < exchange_.size(); ++other) {
            if (of(other).cell_count > 0) ++ranks_with_cells_;
            if (other < rank) cells_before_ += static_cast<std::int64_t>(of(other).cell_count);
            if (asks(rank, other) || asks(other, rank)) partners.push_back(other);
        }
        exchange_.set_partners(std::move(partners));
    });
}

// Whether finer boxes are likely to keep more bytes than they have: both ranks answer alike.
bool Distribution::asks_much(int who, int whom) const {
    if (!asks(who, whom)) return false;
    const Box &points = of(who).points, &cells = of(whom).cells;
    double share = of(who).point_count;
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = points.high[a] / 2 - points.low[a] / 2;
        const double common = std::min(points.high[a], cells.high[a]) / 2 - std::max(points.low[a], cells.low[a]) / 2;
        if (width > 0) share *= common / width;
    }
    return share * 3 * sizeof(double) > 2.0 * fine * sizeof(Box);
}

Status Distribution::refine() {
    Parcels<Box> out;
    Status room = exchange_.everywhere([&] {
        const int rank = exchange_.rank();
        std::vector<Box> mine;
        for (const int other : exchange_.partners()) {
            if (asks_much(other, rank)) {
                if (mine.empty()) {
                    const auto box_of = [&](std::size_t i) { return piece_.box_of(i); };
                    mine = cover(of(rank).cells, piece_.mesh.whole_count(), box_of, fine);
                    mine.resize(fine, empty_box);
                }
                out.values.insert(out.values.end(), mine.begin(), mine.end());
            }
            out.close();
            fine_boxes_.values.resize(fine_boxes_.values.size() + (asks_much(rank, other) ? fine : 0));
            fine_boxes_.close();
        }
    });
    if (!room) return room;
    return exchange_.swap(out, fine_boxes_, true);
}

void Distribution::choose_points(Parcels<double>& coordinates) {
    const std::size_t partners = exchange_.partners().size();
    std::vector<Box> boxes;
    std::vector<std::size_t> owners;
    for (std::size_t k = 0; k < partners; ++k) {
        const int other = exchange_.partners()[k];
        if (!asks(exchange_.rank(), other)) continue;
        const std::span<const Box> given = fine_boxes_.of(k);
        std::copy_if(given.begin(), given.end(), std::back_inserter(boxes), [](const Box& box) { return !empty(box); });
        if (given.empty()) boxes.push_back(of(other).cells);
        owners.resize(boxes.size(), k);
    }
    const index::BoxTree tree(std::move(boxes));
    std::vector<std::vector<std::size_t>> of_partner(partners);
    for (std::size_t i = 0; i < points_.count; ++i) {
        tree.for_each(box_at(i), [&](std::uint32_t box) {
            std::vector<std::size_t>& some = of_partner[owners[box]];
            if (some.empty() || some.back() != i) some.push_back(i);
            return true;
        });
    }
    for (std::vector<std::size_t>& some : of_partner) {
        for (const std::size_t i : some) {
            std::array<double, 3> x{};
            points_.at(i, x.data());
            coordinates.values.insert(coordinates.values.end(), x.begin(), x.end());
        }
        coordinates.close();
        asked_.values.insert(asked_.values.end(), some.begin(), some.end());
        asked_.close();
        some = {};
    }
}

Status Distribution::ask() {
    if (Status done = gather(); !done) return done;
    if (Status done = refine(); !done) return done;
    Parcels<double> coordinates;
    Status room = exchange_.everywhere([&] { choose_points(coordinates); });
    if (!room) return room;
    return exchange_.swap(coordinates, received_);
}

Status Distribution::swap_values(std::span<const Mesh::Index> owners, const std::vector<std::int64_t>& numbers,
                                 const Tuples& tuples) {
    const auto number = [&](Mesh::Index cell) {
        return numbers.empty() ? cells_before_ + cell : numbers[static_cast<std::size_t>(cell)];
    };
    Parcels<char> answers;
    std::vector<char>& bytes = answers.values;
    Status room = exchange_.everywhere([&] {
        // For each point that a partner asks for a bit, set if it has an owner here; for each of these the number of
        // the owner, and the tuple.
        for (std::size_t k = 0; k < exchange_.partners().size(); ++k) {
            const std::size_t count = received_.size(k) / 3, first = points_.count + received_.begin[k] / 3;
            const std::size_t bits = bytes.size();
            bytes.resize(bits + (count + 7) / 8);
            for (std::size_t i = 0; i < count; ++i) {
                if (owners[first + i] < 0) continue;
                bytes[bits + i / 8] = static_cast<char>(bytes[bits + i / 8] | 1 << i % 8);
                const std::int64_t its = number(owners[first + i]);
                const std::size_t at = bytes.size();
                bytes.resize(at + sizeof its);
                std::memcpy(bytes.data() + at, &its, sizeof its);
                tuples.put(first + i, bytes);
            }
            answers.close();
        }
        if (!exchange_.partners().empty())
            best_.assign(points_.count, {std::numeric_limits<std::int64_t>::max(), exchange_.size()});
        for (std::size_t i = 0; i < best_.size(); ++i)
            if (owners[i] >= 0) best_[i] = {number(owners[i]), exchange_.rank()};
    });
    if (!room) return room;
    return exchange_.swap(answers, answered_);
}

void Distribution::merge(Tuples& tuples, char* valid) {
    for (std::size_t k = 0; k < exchange_.partners().size(); ++k) {
        const std::span<const std::size_t> asked = asked_.of(k);
        const char* const bits = answered_.of(k).data();
        const char* bytes = bits + (asked.size() + 7) / 8;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
            Owner its{0, exchange_.partners()[k]};
            std::memcpy(&its.first, bytes, sizeof its.first);
            const bool better = its < best_[asked[i]];
            if (better) {
                best_[asked[i]] = its;
                valid[asked[i]] = 1;
            }
            bytes = tuples.take(asked[i], bytes + sizeof its.first, better);
        }
    }
}

std::string ArrayKind::text() const {
    return (named ? "the array " + name : std::string("an array without a name")) + " of " +
           std::to_string(components) + (components == 1 ? " " : " times ") + type_name;
}

Status agree_on_arrays(Exchange& exchange, bool has_cells, std::vector<ArrayKind>& kinds) {
    double lowest = has_cells ? exchange.rank() : exchange.size();
    exchange.least({&lowest, 1});
    const int from = lowest < exchange.size() ? static_cast<int>(lowest) : 0;
    std::vector<unsigned char> bytes;
    Status read = exchange.everywhere([&] {
        if (exchange.rank() == from) bytes = nlohmann::json::to_cbor(kinds);
    });
    if (!read) return read;
    if (Status done = exchange.broadcast(bytes, from); !done) return done;
    return exchange.everywhere([&]() -> Status {
        auto theirs = exchange.size() == 1 ? kinds : nlohmann::json::from_cbor(bytes).get<std::vector<ArrayKind>>();
        if (std::string differs = has_cells ? difference(kinds, theirs) : std::string(); !differs.empty())
            return Error{
                .code = "rank.source",
                .what = "the source has other arrays than that of rank " + std::to_string(from) + ": " + differs};
        kinds = std::move(theirs);
        return Done{};
    });
}

}  // namespace barycert::pieces
