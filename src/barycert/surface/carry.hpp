/// What cuts and boundaries share: threads, and fields of cells.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "barycert/base/large_pages.hpp"
#include "barycert/surface.hpp"

namespace barycert::surface {

/// Returns work() on `threads` threads, 0 for as many as the machine has, and never on more. They take over the
/// floating-point environment of the caller.
template <class Work>
auto in_arena(int threads, Work&& work) {
    const int available = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
    return arena.execute(std::forward<Work>(work));
}

/// Copies the fields of cells to the cells of the surface, by mesh_cells.
inline void carry_cell_fields(const CutOptions& options, Surface& surface) {
    for (const Field* const field : options.cell_fields) {
        Field& to = surface.cell_fields.emplace_back(Field{field->name, field->components, {}});
        const auto components = static_cast<std::size_t>(field->components);
        base::resize_large(to.data, components * surface.mesh_cells.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.mesh_cells.size(), 4096), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const auto cell = static_cast<std::size_t>(surface.mesh_cells[i]);
                std::copy_n(field->data.data() + components * cell, components, to.data.data() + components * i);
            }
        });
    }
}

}  // namespace barycert::surface
