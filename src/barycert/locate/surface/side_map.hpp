/// On which side of a surface the bins of a grid lie that no triangle touches.
#pragma once

#include "barycert/locate/names.hpp"

namespace barycert::locate {

struct SurfaceData;

/// The box of the surface in bins: whole numbers of the quantizer without their last bits. All points of a bin that no
/// triangle touches have one winding number, and so have two such bins side by side: what no triangle touches is
/// connected, and windings change nowhere but on triangles.
class SideMap {
public:
    explicit SideMap(const SurfaceData& surface);

    static constexpr std::int16_t touched = INT16_MIN;
    /// The winding number of a point in the box, exactly; `touched`, if a triangle touches its bin.
    std::int16_t at(const double* point) const { return sides_[bin_of(point)]; }

    /// A point on the ray from `point` along the first axis, in the next bin that no triangle touches, and its winding;
    /// beyond the box that is 0.
    std::int16_t next(const double* point, double (&end)[3]) const;

    std::size_t bytes() const { return sides_.size() * sizeof(std::int16_t); }

private:
    std::int32_t on_axis(std::size_t k, double x) const { return bins_->quantizer().at(k, x) >> shift_[k]; }
    std::size_t bin_of(const double* p) const { return bin(on_axis(0, p[0]), on_axis(1, p[1]), on_axis(2, p[2])); }
    std::size_t bin(std::int32_t i, std::int32_t j, std::int32_t k) const {
        return (static_cast<std::size_t>(k) * size_[1] + static_cast<std::size_t>(j)) * size_[0] +
               static_cast<std::size_t>(i);
    }
    void touch(const SurfaceData& surface);
    void fill(const SurfaceData& surface);
    /// A point of the bin, if rounding leaves one there.
    bool middle_of(std::size_t bin, double (&p)[3]) const;

    const Bins* bins_;
    int shift_[3] = {};
    std::size_t size_[3] = {};
    std::vector<std::int16_t> sides_;
};

}  // namespace barycert::locate
