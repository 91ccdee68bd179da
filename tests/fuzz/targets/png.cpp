// PNG files: textures.
#include "barycert/raster.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

/// Pixels of one colour compress to a thousandth; a pixel of one bit becomes four bytes.
BARYCERT_FUZZ_TARGET(png, {std::size_t{4} << 20, std::size_t{1} << 16}) {
    static InputFile file("in.png");
    static const std::string out = scratch_path("out.png");
    const Result<Image> image = read_png(file.put(input));
    if (!image) return expect_useful(image.error(), lines_of(input));
    expect(bool(check_image(*image)), "an image that is none was read");
    const Status written = write_png(without_file(out), *image);
    expect(bool(written), "an image that was read is not written", written ? "" : written.error().message());
    const Result<Image> again = read_png(out);
    expect(bool(again) && *again == *image, "another image came back");
}

}  // namespace barycert::fuzz
