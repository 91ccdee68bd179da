#include "draw/raster/resolve.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster.hpp"

namespace barycert::raster {
namespace {

/// The light of each component in sRGB (IEC 61966-2-1), in 65535ths: rounded so far that it is the same on all
/// machines.
const std::array<std::uint16_t, 256>& light() {
    static const std::array<std::uint16_t, 256> all = [] {
        std::array<std::uint16_t, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            const double x = static_cast<double>(i) / 255;
            const double l = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
            table[i] = static_cast<std::uint16_t>(std::lround(65535 * l));
        }
        return table;
    }();
    return all;
}

/// The component whose light is nearest.
std::uint8_t component(std::uint64_t l) {
    const auto& table = light();
    const auto above = std::ranges::lower_bound(table, l);
    if (above == table.begin()) return 0;
    if (above == table.end()) return 255;
    const auto i = static_cast<std::uint8_t>(above - table.begin());
    return *above - l <= l - *(above - 1) ? i : static_cast<std::uint8_t>(i - 1);
}

}  // namespace

void resolve(std::span<const Rgba> colours, int samples, std::int32_t width, std::int32_t row, Image& image) {
    const auto n = static_cast<std::size_t>(samples), across = static_cast<std::size_t>(width) * n;
    const auto& table = light();
    for (std::size_t at = 0; at < colours.size(); at += across * n, ++row) {
        for (std::int32_t i = 0; i < width; ++i) {
            const Rgba* const corner = colours.data() + at + n * static_cast<std::size_t>(i);
            bool same = true;
            for (std::size_t s = 0; s < n * n && same; ++s) same = corner[s / n * across + s % n] == *corner;
            if (same) {
                image.set_pixel(i, row, *corner);
                continue;
            }
            std::array<std::uint64_t, 3> sum{};
            std::uint64_t opacity = 0;
            for (std::size_t s = 0; s < n * n; ++s) {
                const Rgba& c = corner[s / n * across + s % n];
                opacity += c[3];
                for (std::size_t k = 0; k < 3; ++k) sum[k] += std::uint64_t{c[3]} * table[c[k]];
            }
            Rgba out{0, 0, 0, static_cast<std::uint8_t>((opacity + n * n / 2) / (n * n))};
            for (std::size_t k = 0; k < 3 && opacity != 0; ++k) out[k] = component((sum[k] + opacity / 2) / opacity);
            image.set_pixel(i, row, out);
        }
    }
}

}  // namespace barycert::raster
