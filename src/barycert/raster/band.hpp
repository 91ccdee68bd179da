/// Rows of pixels, and the samples in them.
#pragma once

#include <memory>

#include "barycert/raster/parts.hpp"

namespace barycert::raster {

class Band {
public:
    /// Rows of pixels begin ... end - 1.
    Band(const Layers& layers, std::int32_t begin, std::int32_t end);
    ~Band();
    Band(const Band&) = delete;
    Band& operator=(const Band&) = delete;

    /// `numbers`: layers.numbers of each vertex. True if it covers a sample.
    bool draw(const Part& part, std::span<const double> numbers);
    /// When all is drawn: into the rows of the image, and what has become of samples.
    RenderCounts resolve_into(Image& image);

private:
    class Samples;
    std::unique_ptr<Samples> samples_;
};

}  // namespace barycert::raster
