// Mesa's software OpenGL (llvmpipe, through OSMesa) as a peer of bench_raster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raster_peers.hpp"

namespace barycert::bench {

struct MesaAnswer {
    std::string version;                ///< empty: there is none
    std::vector<double> seconds;        ///< by the clock, of each repetition
    std::vector<std::uint32_t> pixels;  ///< of the first `pictures` triangles, each drawn alone; rows upwards
};

/// Draws the triangles, in a process of its own, with that many threads, as OpenGL does: textured, in perspective,
/// texels by the nearest. Pictures are side * side.
MesaAnswer draw_by_mesa(std::int32_t side, const TexelRows& texture, const std::vector<TexturedVertex>& corners,
                        int threads, int repetitions, std::size_t pictures);

}  // namespace barycert::bench
