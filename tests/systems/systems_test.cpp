/// The league itself: what fails is told in the right place, and no answer passes for a good one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scratch.hpp"
#include "tests/systems/asking.hpp"

namespace barycert::systems {
namespace {

/// A system that answers `times` times and then fails; in a folder whose name the shell would take apart.
class Failing : public ::testing::Test {
protected:
    System answering(int times) {
        const std::string folder = scratch_.path("it's a $HOME");
        std::filesystem::create_directory(folder);
        const std::string script =
            scratch_.put("it's a $HOME/system.sh",
                         "here=$(dirname \"$0\"); echo >>\"$here/calls\"\n"
                         "if [ $(wc -l <\"$here/calls\") -gt " +
                             std::to_string(times) +
                             " ]; then echo 'first line' >&2; echo 'out of luck' >&2; exit 3; fi\n"
                             "exec \"" BARYCERT_SYSTEM_BARYCERT "\" all \"$@\"\n");
        return {"failing", {"sh", script}};
    }

    Standing asked(const System& system) {
        static const std::vector<NamedMesh> meshes = meshes_for_systems();
        Standing standing;
        standing.name = system.name;
        ask(system, meshes.at(0), league_, standing);
        league_.standings = {standing};
        return standing;
    }

    League league_{.seed = 1, .count = 10, .meshes = {}, .sets = {}, .standings = {}};

private:
    test::Scratch scratch_;
};

constexpr const char* reason = "lattice: ended by itself with code 3: out of luck";

TEST_F(Failing, Never) {
    const Standing s = asked(answering(2));
    EXPECT_EQ(s.total.points, 80U);
    EXPECT_EQ(s.total.missed + s.total.invented + s.total.wrong_cell, 0U);
    EXPECT_TRUE(s.failures.empty());
    EXPECT_TRUE(s.not_timed.empty());
    EXPECT_EQ(s.ns.size(), 1U);
}

TEST_F(Failing, AtOnce) {
    const Standing s = asked(answering(0));
    EXPECT_EQ(s.total.points, 0U);
    EXPECT_EQ(s.failures, std::vector<std::string>{reason});
    EXPECT_TRUE(s.not_timed.empty());
    const std::string text = league_markdown(league_);
    EXPECT_NE(text.find("failing, not counted above:\n\n- " + std::string(reason)), std::string::npos) << text;
    EXPECT_NE(text.find("| no answers |"), std::string::npos) << text;
}

// Answers given before the failure count.
TEST_F(Failing, WhenItIsTimed) {
    const Standing s = asked(answering(1));
    EXPECT_EQ(s.total.points, 80U);
    EXPECT_TRUE(s.failures.empty());
    EXPECT_EQ(s.not_timed, std::vector<std::string>{reason});
    EXPECT_TRUE(s.ns.empty());
    const std::string text = league_markdown(league_);
    EXPECT_NE(text.find("failing, counted, but not timed:\n\n- " + std::string(reason)), std::string::npos) << text;
    EXPECT_EQ(text.find("not counted above"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(league_json(league_)).at("systems").at(0);
    EXPECT_TRUE(json.at("failures").empty());
    EXPECT_EQ(json.at("not_timed"), (nlohmann::json{reason}));
    EXPECT_TRUE(json.at("ns_a_random_point").is_null());
}

class OtherCells : public ::testing::Test {
protected:
    static Standing asked(const std::string& name, const System& system) {
        static const std::vector<NamedMesh> meshes = meshes_for_systems();
        const League league{.seed = 1, .count = 10, .meshes = {}, .sets = {}, .standings = {}};
        Standing standing;
        standing.name = system.name;
        standing.kind = CellKind::others;
        for (const NamedMesh& mesh : meshes)
            if (mesh.name == name) ask(system, mesh, league, standing);
        return standing;
    }
    const System barycert_{"barycert", {BARYCERT_SYSTEM_BARYCERT, "all"}};
};

// Or the judge would take them for something else than the systems do.
TEST_F(OtherCells, AllHaveTheirMaps) {
    std::size_t meshes = 0;
    for (const NamedMesh& mesh : meshes_for_systems()) {
        if (kind_of(mesh.mesh) != CellKind::others) continue;
        const Locator locator =
            Locator::build(mesh.mesh, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
        EXPECT_EQ(locator.unmapped_cells(), 0U) << mesh.name;
        EXPECT_TRUE(locator.certified()) << mesh.name;
        ++meshes;
    }
    EXPECT_EQ(meshes, 9U);
}

TEST_F(OtherCells, HaveATableOfTheirOwn) {
    for (const char* const name : {"mixed-warped", "curved"}) {
        const Standing s = asked(name, barycert_);
        EXPECT_TRUE(s.failures.empty()) << s.failures.front();
        EXPECT_EQ(s.total.points, 80U);
        EXPECT_EQ(s.total.missed + s.total.invented + s.total.wrong_cell, 0U);
        EXPECT_EQ(s.total.max_error, 0);
        const League league{.seed = 1, .count = 10, .meshes = {{name, ""}}, .sets = {}, .standings = {s}};
        const std::string text = league_markdown(league);
        EXPECT_EQ(text.find("### Tetrahedra"), std::string::npos);
        EXPECT_NE(text.find("### Other cells"), std::string::npos);
        EXPECT_NE(text.find("| " + std::string(name) + " | 0 / 0 / 0 / 0 |"), std::string::npos) << text;
        const auto json = nlohmann::json::parse(league_json(league));
        EXPECT_TRUE(json.at("systems").empty());
        EXPECT_EQ(json.at("systems_of_other_cells").at(0).at("by_mesh").at(name).at("points"), 80);
    }
}

// Who names cell 0 for every point is wrong.
TEST_F(OtherCells, WrongAnswersAreCounted) {
    const test::Scratch scratch;
    const std::string script = scratch.put("system.sh", "\"" BARYCERT_SYSTEM_BARYCERT
                                                        "\" all \"$@\" && size=$(wc -c <\"$2/owners.i64\") && "
                                                        "head -c \"$size\" /dev/zero >\"$2/owners.i64\"\n");
    const Standing s = asked("hexahedra-warped", {"liar", {"sh", script}});
    EXPECT_TRUE(s.failures.empty()) << s.failures.front();
    EXPECT_EQ(s.total.invented, s.total.outside);
    EXPECT_GT(s.total.outside, 10U);
    EXPECT_GT(s.total.wrong_cell, 40U);
}

}  // namespace
}  // namespace barycert::systems
