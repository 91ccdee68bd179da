/// Some layers of a grid.
#pragma once

#include "barycert/base/lists.hpp"
#include "barycert/grid.hpp"
#include "barycert/sample/grid/fill_lanes.hpp"
#include "barycert/sample/points/chunk_sampler.hpp"

namespace barycert::sample {

/// For each slab of `depth` layers (the last may have fewer) all cells that may hold points of it, as the index goes.
class SlabCells {
public:
    SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth);

    /// Calls work(cells), one part of them after the other.
    template <class Work>
    void for_parts(std::size_t slab, Work work) const {
        for (const Part& part : parts_) {
            if (slab < part.first_slab || slab - part.first_slab >= part.cells.size()) continue;
            const std::span<const locate::Place> cells = part.cells[slab - part.first_slab];
            if (!cells.empty()) work(cells);
        }
    }

private:
    /// Of cells that follow one another: those of each slab, from the first one on.
    struct Part {
        std::size_t first_slab = 0;
        base::Lists<locate::Place> cells;
    };
    std::vector<Part> parts_;
};

/// Layers [first, last) of the third axis (2D: of the second), and the rows of their points. Keeps its memory from slab
/// to slab.
class SlabSampler {  // NOLINT(clang-analyzer-optin.performance.Padding): one a thread
public:
    SlabSampler(const SamplerData& data, const Grid& grid, const Raster& raster, const SampleOptions& options)
        : data_(data), grid_(grid), raster_(raster), options_(options) {}

    /// By the cells of slab `slab`, which has these layers.
    void run(std::int32_t first, std::int32_t last, const SlabCells& cells, std::size_t slab);

    TableView block() const;
    const SampleCounts& counts() const { return counts_; }
    /// The first point outside, if the policy refuses such.
    std::optional<std::uint64_t> refused() const;

private:
    void fill(std::span<const locate::Place> cells);
    void take(locate::Place cell);
    void take(const Span& span);
    void take(const UndecidedPoint& one);
    std::optional<std::size_t> own(locate::Place cell, const std::array<std::int32_t, 3>& places, bool with_value);
    void finish();
    void push(std::size_t point);
    Feature feature_of(std::size_t point) const {
        return static_cast<Feature>(static_cast<std::uint8_t>(found_.features[point]) & ~value_missing);
    }

    const SamplerData& data_;
    const Grid& grid_;
    const Raster& raster_;
    const SampleOptions& options_;
    FillTarget target_;
    std::size_t points_ = 0;
    bool filled_ = false;  ///< cells fill in values
    FoundRows found_;
    SampleCounts counts_;
    std::optional<ChunkSampler> sampler_;
    UndecidedFill undecided_;
    FinishedPoints finished_;
};

}  // namespace barycert::sample
