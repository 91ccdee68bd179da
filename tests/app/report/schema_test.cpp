// The JSON that is written and doc/json.md say the same, member by member, both ways.

#include <algorithm>
#include <iterator>
#include <limits>

#include <gtest/gtest.h>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/error_report.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gaps.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mutants.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/report.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "check_meshes.hpp"
#include "schema_tables.hpp"
#include "small_audit.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::report_test {
namespace {

using Json = nlohmann::json;

/// Reports on meshes that have something of everything, and those that have nothing.
void check_reports(Schema& schema) {
    Mesh no_mesh = pair_of_cells();
    no_mesh.cells.pop_back();
    for (const Mesh& mesh : {own_mesh("bracket"), own_mesh("plate"), pair_of_cells(), thoroughly_broken(),
                             broken_plane(), Mesh(), no_mesh}) {
        for (const bool delaunay : {false, true}) {
            const std::string text = check_json(checked(mesh, delaunay), "part", measure_environment());
            schema.check("Check", Json::parse(text), "check");
        }
    }
    const Plc plc = read_plc(BARYCERT_DATA_DIR "/plc/torus.off").value();
    CheckOptions options;
    options.plc = &plc;
    const std::string text = check_json(check_mesh(own_mesh("torus"), options), "part", measure_environment());
    schema.check("Check", Json::parse(text), "check");
    Plc with_holes = read_plc(BARYCERT_DATA_DIR "/plc/cube-hole.poly").value();
    with_holes.holes.insert(with_holes.holes.end(),
                            {9, 9, 9, with_holes.points[0], with_holes.points[1], with_holes.points[2]});
    for (const Plc& one : {plc, with_holes})
        schema.check("Check", Json::parse(check_json(check_plc(one), "part", measure_environment())), "check");
    Mesh holed = own_mesh("bracket");
    holed.point_fields = {{"T", 1, std::vector<double>(holed.point_count(), HUGE_VAL)}};
    schema.check("Check", Json::parse(check_json(checked(holed, false), "part", measure_environment())), "check");
    for (const std::uint8_t type : {std::uint8_t{12}, std::uint8_t{14}}) {
        Mesh whole = test::one_cell(type, {0, 1, 2, 3, 4, 5, 6, 7});
        test::cut(whole);
        schema.check("Check", Json::parse(check_json(checked(whole), "part", measure_environment())), "check");
    }
    CheckReport by_corners = checked(own_mesh("bracket"));
    by_corners.curved.by_corners = 1;
    schema.check("Check", Json::parse(check_json(by_corners, "part", measure_environment())), "check");
    const Mesh apart = cracked_and_hanging();
    FixedMesh fixed{.file = "copy.vtu", .done = {}, .after = {}};
    fixed.after = checked(fix_mesh(apart, {}, fixed.done).value());
    fixed.done.cell_fields = {{"rho", 1, 0.5}};
    fixed.notes = {{Note::Kind::left_out, "labels"}};
    const std::string repaired = check_json(checked(apart), "part", measure_environment(), &fixed);
    schema.check("Check", Json::parse(repaired), "check");
}

/// A failure with something of everything, and one of little.
void failures(Schema& schema) {
    Error full =
        about("job.points", file_error("file.truncated", "a.csv", "the \xff file ends", "more", "less", "copy it"));
    full.line = 3;
    schema.check("Failure", Json::parse(error_json(full, "--points")), "failure");
    schema.check("Failure", Json::parse(error_json({.code = "memory.short", .what = "too little"})), "failure");
}

/// Runs of sampling with something of everything.
void sample_reports(Schema& schema) {
    SampleReport run;
    run.columns = {"t"};
    run.carried = {"id"};
    run.counts.locations.ways.walk = 1;
    run.notes = {{Note::Kind::guessed, "the order", "a file"}};
    run.not_finite = {{"t", true, 3, 50}};
    for (const double low : {0.25, std::numeric_limits<double>::quiet_NaN()}) {
        run.picture = FigureCounts{
            .size = {}, .render = {}, .low = low, .high = low, .below = 1, .above = 2, .grid = {.drawn = 3}};
        schema.check("Sample", Json::parse(sample_json(run, measure_environment())), "sample");
        run.from = PointsFrom::mesh;
        run.simplices = 6;
        run.weights = "w.npz";
        run.steps = {"1", "2"};
        run.times = {0, 0.5};
        run.integrals = {{.column = "t", .source = 1, .target = 2}};
        run.grid = Grid{.dimension = 3, .counts = {2, 1, 2}, .origin = {-1, 0, 0}, .spacing = {1, 0, 1}, .last = {}};
    }
}

/// Verifications with something of everything.
void verify_reports(Schema& schema) {
    VerifyReport run;
    for (const bool much : {false, true}) {
        if (much) {
            run.dimension = 2;
            run.simplices = 6;
            run.cell_column = "cell";
            run.mask_column = "mask";
            run.outside_value = 0;
            run.columns = run.found_in = {"T"};
            run.ranges = {2};
            run.relative_to = {RelativeTo::range};
            run.verdicts.columns.resize(1);
            run.notes = {{Note::Kind::guessed, "the order", "a file"}};
        }
        WrongRow row;
        row.verdict = RowVerdict::wrong_value;
        run.verdicts.examples = {row};
        schema.check("Verify", Json::parse(verify_json(run, measure_environment())), "verify");
        row.verdict = RowVerdict::invented;
        row.exact.cell = 1;
        row.claimed_cell = 1;
        row.claimed = row.value = std::numeric_limits<double>::quiet_NaN();
        row.ulps = HUGE_VAL;
        run.verdicts.examples = {row, row};
        run.verdicts.examples.back().distance = std::numeric_limits<double>::quiet_NaN();
        schema.check("Verify", Json::parse(verify_json(run, measure_environment())), "verify");
    }
}

/// A search and a mutation score with something of everything.
void search_reports(Schema& schema) {
    SearchOptions options;
    options.kernel = kernels_matching("tetrahedron.signed-volume").at(0);
    options.steps = 20000;
    schema.check("Search", Json::parse(search_json(search_worst_case(options).value())), "search");
    MutantReport score;
    score.mutants = {{all_mutants().at(0), 3, {{"random", "worst_weight_ulp", -1, 5}, {"tiny", "false_zero", 0, 5}}}};
    schema.check("Mutants", Json::parse(mutants_json(score)), "mutants");
}

/// Drift, texels, surfaces and inverse maps, with something of everything.
void raster_reports(Schema& schema) {
    DriftOptions options;
    options.kernels = kernels_matching("triangle.signed-area");
    options.count = 20;
    schema.check("Drift", Json::parse(drift_json(measure_drift(options).value())), "drift");
    schema.check("Texels", Json::parse(texels_json(audit_texels(texel_rules(), 2000))), "texels");
    SurfaceAudit surfaces{.count = 40};
    audit_surfaces(surfaces);
    schema.check("Surfaces", Json::parse(surfaces_json(surfaces)), "surfaces");
    InverseAudit inverses{.count = 40};
    audit_inverses(inverses);
    schema.check("Inverses", Json::parse(inverses_json(inverses)), "inverses");
}

/// Gaps on a mesh, and an audit of a kernel in a process of its own, as far as that has members of its own.
void kernel_reports(Schema& schema) {
    GapsOptions options;
    options.kernels = kernels_matching("tetrahedron.unsigned-volume");
    options.count = 100;
    auto gaps = find_gaps(options, own_mesh("bracket"), "bracket", Verdict::certified);
    schema.check("Gaps", Json::parse(gaps_json(gaps.value())), "gaps");
    AuditReport report = audited();
    report.kernels.front().witnesses.front().detail = "SIGSEGV";
    schema.check("Report", Json::parse(audit_json(report)), "report");
}

/// Runs of cutting with something of everything.
void contour_reports(Schema& schema) {
    ContourReport run;
    run.file.left_out = {"a"};
    for (const double low : {0.25, std::numeric_limits<double>::quiet_NaN()}) {
        run.low = run.high = low;
        run.value = 1;
        run.simplices = 6;
        run.view = RasterSize{};
        run.colours = "T";
        run.drawn.low = run.drawn.high = low;
        schema.check("Contour", Json::parse(contour_json(run, measure_environment())), "iso");
        run.value.reset();
        run.view.reset();
        run.plane = Plane{};
        run.pixels = PixelGrid{};
        schema.check("Contour", Json::parse(contour_json(run, measure_environment())), "slice");
        run.view = RasterSize{};
        schema.check("Contour", Json::parse(contour_json(run, measure_environment())), "drawn slice");
    }
}

/// Pictures with something of everything.
void render_reports(Schema& schema) {
    RenderReport picture;
    picture.picture = "mesh";
    for (const double low : {0.25, std::numeric_limits<double>::quiet_NaN()}) {
        picture.colours = ColourRange{"t", low, low, 1};
        picture.texel_error = TexelError{low == 0.25 ? low : HUGE_VAL, 1, 2};
        schema.check("Render", Json::parse(render_json(picture, measure_environment())), "render");
    }
}

/// Everything that is written, checked against a schema.
Schema schema_with_all_reports() {
    Schema schema(BARYCERT_SCHEMA);
    schema.check("Report", Json::parse(audit_json(audited())), "report");
    schema.check("Witnesses", Json::parse(witnesses_json(audited())), "witnesses");
    schema.check("Kernels", Json::parse(kernels_json(catalogue())), "kernels");
    schema.check("Families", Json::parse(families_json(all_families())), "families");
    check_reports(schema);
    failures(schema);
    sample_reports(schema);
    verify_reports(schema);
    raster_reports(schema);
    kernel_reports(schema);
    contour_reports(schema);
    render_reports(schema);
    search_reports(schema);
    return schema;
}

/// Members of Kernel and Statistics are met as members of those sections that take them over.
std::set<std::string> without_templates(std::set<std::string> names) {
    std::erase_if(names, [](const std::string& name) {
        return name.starts_with("Statistics.") || name.starts_with("GapCounts.");
    });
    return names;
}

TEST(Schema, EveryMemberWrittenIsDocumented) {
    const Schema schema = schema_with_all_reports();
    EXPECT_EQ(schema.complaints, std::vector<std::string>{});
}

TEST(Schema, EveryMemberDocumentedIsWritten) {
    const Schema schema = schema_with_all_reports();
    const std::set<std::string> documented = without_templates(schema.documented());
    std::vector<std::string> unseen, unnamed;
    std::ranges::set_difference(documented, schema.seen, std::back_inserter(unseen));
    std::ranges::set_difference(schema.seen, documented, std::back_inserter(unnamed));
    EXPECT_EQ(unseen, std::vector<std::string>{});
    EXPECT_EQ(unnamed, std::vector<std::string>{});
    EXPECT_GT(schema.seen.size(), 100U);
}

TEST(Schema, NullIsMetWhereItIsDocumentedAndSoIsAFigure) {
    const Schema schema = schema_with_all_reports();
    std::vector<std::string> differ;  // gtest cuts long sets off
    const std::set<std::string> nullable = without_templates(schema.nullable());
    std::ranges::set_symmetric_difference(schema.seen_null, nullable, std::back_inserter(differ));
    EXPECT_EQ(differ, std::vector<std::string>{});
    EXPECT_EQ(schema.seen_value, schema.seen);
}

TEST(Schema, TheCheckItselfFindsFaults) {
    Json report = Json::parse(audit_json(audited()));
    const auto complaints = [](const Json& changed) {
        Schema schema(BARYCERT_SCHEMA);
        schema.check("Report", changed, "report");
        return schema.complaints;
    };
    EXPECT_EQ(complaints(report).size(), 0U);
    Json more = report;
    more["kernels"][0]["confusion"]["outside"]["lost"] = 1;
    EXPECT_EQ(complaints(more),
              std::vector<std::string>{"report.kernels[].confusion.outside.lost is not documented in Claims"});
    Json less = report;
    less["environment"].erase("fma");
    EXPECT_EQ(complaints(less), std::vector<std::string>{"report.environment has no fma"});
    Json null = report;
    null["kernels"][0]["cases"] = nullptr;
    EXPECT_EQ(complaints(null), std::vector<std::string>{"report.kernels[].cases is no integer: null"});
    Json hex = report;
    hex["witnesses"][0]["point"][0] = "0x1.80p+1";
    EXPECT_EQ(complaints(hex), std::vector<std::string>{"report.witnesses[].point[] is no hex: \"0x1.80p+1\""});
}

TEST(Schema, NumbersReadBackToTheSameBits) {
    const Json report = Json::parse(audit_json(audited()));
    for (std::size_t i = 0; i < audited().kernels.size(); ++i) {
        const KernelResult& k = audited().kernels[i];
        const Json& j = report["kernels"][i];
        ASSERT_EQ(j["name"], k.kernel.name);
        const auto same = [](const Json& written, double x) { return x < 0 ? written.is_null() : written == x; };
        EXPECT_TRUE(same(j["worst_weight_ulp"], k.total.weight_ulp.value));
        EXPECT_TRUE(same(j["worst_value_ulp"], k.total.value_ulp.value));
        EXPECT_TRUE(same(j["worst_partition_residual"], k.total.partition_residual.value));
        EXPECT_EQ(j["wrong_cases"], k.total.wrong_cases);
        std::uint64_t confusion = 0;
        for (const Json& row : j["confusion"]) {
            for (const Json& n : row) confusion += n.get<std::uint64_t>();
        }
        EXPECT_EQ(confusion, k.total.cases);
    }
}

TEST(Schema, AnInfiniteResidualIsNotHiddenByNull) {
    AuditReport report = audited();
    report.kernels.resize(1);
    report.kernels[0].total.reproduction_residual.value = std::numeric_limits<double>::infinity();
    report.kernels[0].total.partition_residual.value = -1;
    const Json j = Json::parse(audit_json(report))["kernels"][0];
    EXPECT_EQ(j["worst_reproduction_residual"], std::numeric_limits<double>::max());
    EXPECT_TRUE(j["worst_partition_residual"].is_null());
}

TEST(Schema, TheNumberIsTheDocumentedOne) {
    EXPECT_EQ(audit_schema, 1);
    EXPECT_EQ(witness_schema, 1);
    EXPECT_EQ(check_schema, 1);
    EXPECT_EQ(sample_schema, 1);
    EXPECT_EQ(render_schema, 1);
    EXPECT_EQ(contour_schema, 1);
}

}  // namespace
}  // namespace barycert::report_test
