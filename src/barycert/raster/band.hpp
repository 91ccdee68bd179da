/// Rows of pixels, and the samples in them.
#pragma once

#include <memory>

#include "barycert/raster/parts.hpp"

namespace barycert::raster {

class Band {
public:
    /// Rows of pixels begin ... end - 1.
    static std::unique_ptr<Band> over(const Layers& layers, std::int32_t begin, std::int32_t end);
    virtual ~Band() = default;

    /// `numbers`: layers.numbers of each vertex. True if it covers a sample.
    virtual bool draw(const Part& part, std::span<const double> numbers) = 0;
    /// When all is drawn: into the rows of the image, and what has become of samples.
    virtual RenderCounts resolve_into(Image& image) = 0;
};

}  // namespace barycert::raster
