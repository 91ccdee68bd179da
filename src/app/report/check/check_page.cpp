// The report on a check as a page, with pictures.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/report/check/check_document.hpp"
#include "app/report/check/check_pictures.hpp"
#include "app/report/common/document.hpp"
#include "barycert/check_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "draw/picture.hpp"

namespace barycert {

using namespace report;

namespace {

/// As a picture of a page.
std::string surface_figure(const CheckReport& r, const Surface& surface) {
    const Result<Image> image = draw_checked(r, surface);
    if (!image) return "";
    const bool marked = std::ranges::any_of(r.measures.defects, [](DefectSet d) { return d != 0; });
    return fmt::format(
        "<figure><img src=\"{}\" alt=\"the surface from two sides\" width=\"{}\" height=\"{}\"/>\n"
        "<figcaption>From in front and from behind.{}</figcaption></figure>\n",
        data_uri("image/png", png_text(*image)), image->width, image->height,
        marked ? " Red: triangles with defects." : "");
}

std::string page_of(const CheckReport& r, const CheckSubject& of) {
    return written_page([&] {
        Document d = check_document(r, of);
        d.style = check_style;
        return d;
    });
}

}  // namespace

std::string check_html(const CheckReport& report, const Mesh& mesh, const std::string& name, const FixedMesh* fixed) {
    return page_of(report, {.mesh = mesh,
                            .name = name,
                            .fixed = fixed,
                            .exhibits = [&] { return exhibits(report, mesh); },
                            .histograms = [&] { return histograms(report); }});
}

std::string check_html(const CheckReport& report, const Surface& surface, const std::string& name) {
    Mesh none;
    none.index_base = surface.index_base;
    return page_of(report, {.mesh = none, .name = name, .surface = [&] { return surface_figure(report, surface); }});
}

}  // namespace barycert
