// Witnesses: they show what they say, and survive a file bit for bit.

#include "barycert/witness.hpp"
#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "audit/recipes.hpp"
#include "audit_helpers.hpp"
#include "barycert/audit_report.hpp"
#include "compared_weights.hpp"

namespace barycert::audit {
namespace {

AuditReport nasty_audit() {
    return audit_of(
        catalogue(),
        {family_named("huge"), family_named("subnormal"), family_named("lattice.tenths"), family_named("mesh.faces"),
         family_named("perspective.pixel-edges"), family_named("perspective.depth-ratio")},
        300, own_meshes());
}

class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& bytes)
        : path_(testing::TempDir() + "witness-" + std::to_string(getpid()) + ".json") {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    ~TemporaryFile() { std::remove(path_.c_str()); }
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

TEST(Witness, ShowsWhatItSays) {
    int seen = 0;
    for (const KernelResult& k : nasty_audit().kernels) {
        for (const Witness& w : k.witnesses) {
            const OracleAnswer answer = ask_oracle(w.c);
            std::array<double, 4> weights{};
            const int status = k.kernel.weights(w.c.vertices.data(), w.c.point.data(), weights.data());
            const Comparison r = compare(k.kernel, w.c, answer, status, weights);
            if (w.reason == "worst_value_ulp") {
                EXPECT_EQ(r.value_ulp, w.magnitude) << k.kernel.name;
            } else if (w.reason == "worst_weight_ulp") {
                EXPECT_EQ(*std::max_element(r.weight_ulps.begin(), r.weight_ulps.end()), w.magnitude) << k.kernel.name;
            } else {
                const auto finding = finding_named(w.reason);
                ASSERT_TRUE(finding) << w.reason;
                EXPECT_GT(r.counts[static_cast<std::size_t>(*finding)], 0) << k.kernel.name << " " << w.reason;
                EXPECT_EQ(r.weight_error, w.magnitude) << k.kernel.name << " " << w.reason;
            }
            ++seen;
        }
    }
    EXPECT_GT(seen, 100);
}

void expect_same(const std::vector<Witness>& read, const AuditReport& report) {
    std::size_t i = 0;
    for (const KernelResult& k : report.kernels) {
        for (const Witness& w : k.witnesses) {
            ASSERT_LT(i, read.size());
            EXPECT_EQ(read[i].kernel, w.kernel);
            EXPECT_EQ(read[i].reason, w.reason);
            EXPECT_EQ(read[i].family, w.family);
            EXPECT_EQ(read[i].index, w.index);
            EXPECT_EQ(read[i].seed, w.seed);
            EXPECT_EQ(read[i].mesh, w.mesh);
            EXPECT_EQ(read[i].cell, w.cell);
            EXPECT_EQ(read[i].c.simplex, w.c.simplex);
            EXPECT_EQ(read[i].c.perspective, w.c.perspective);
            for (std::size_t x = 0; x < 12; ++x)
                EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i].c.vertices[x]),
                          std::bit_cast<std::uint64_t>(w.c.vertices[x]));
            for (std::size_t x = 0; x < 3; ++x)
                EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i].c.point[x]), std::bit_cast<std::uint64_t>(w.c.point[x]));
            for (std::size_t x = 0; x < 4; ++x)
                EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i].c.values[x]),
                          std::bit_cast<std::uint64_t>(w.c.values[x]));
            ++i;
        }
    }
    EXPECT_EQ(i, read.size());
}

TEST(Witness, FilesKeepEveryBit) {
    const AuditReport report = nasty_audit();
    expect_same(read_witnesses(TemporaryFile(witnesses_json(report)).path()).value(), report);
    expect_same(read_witnesses(TemporaryFile(audit_json(report)).path()).value(), report);
}

TEST(Witness, OfAMeshNamesMeshAndCell) {
    int from_meshes = 0, others = 0;
    for (const KernelResult& k : nasty_audit().kernels) {
        for (const Witness& w : k.witnesses) {
            if (!w.family.starts_with("mesh.")) {
                ++others;
                EXPECT_EQ(w.cell, -1);
                EXPECT_EQ(w.mesh, "");
                continue;
            }
            ++from_meshes;
            const auto& meshes = own_meshes().meshes();
            const auto from =
                std::find_if(meshes.begin(), meshes.end(), [&](const auto& m) { return m->name == w.mesh; });
            ASSERT_NE(from, meshes.end()) << w.mesh;
            const Mesh& mesh = (*from)->mesh;
            // Each vertex is a corner of the cell.
            const int d = space_dimension(w.c.simplex);
            for (int i = 0; i < vertex_count(w.c.simplex); ++i) {
                bool found = false;
                for (std::size_t corner = 0; corner < mesh.corners(); ++corner) {
                    const auto node = static_cast<std::size_t>(
                        mesh.cells[static_cast<std::size_t>(w.cell) * mesh.corners() + corner]);
                    bool same = true;
                    for (int axis = 0; axis < d; ++axis)
                        same =
                            same && mesh.points[node * static_cast<std::size_t>(d) + static_cast<std::size_t>(axis)] ==
                                        w.c.vertex(i, axis);
                    found = found || same;
                }
                EXPECT_TRUE(found) << w.kernel << ' ' << w.family << ' ' << w.index;
            }
        }
    }
    EXPECT_GT(from_meshes, 20);
    EXPECT_GT(others, 20);
}

// Read from a file, a witness of perspective is shown beside the kernels for such cases, and no others.
TEST(Witness, PerspectiveIsReplayedWithItsOwnKernels) {
    const AuditReport report = nasty_audit();
    int seen = 0;
    const std::vector<Witness> read = read_witnesses(TemporaryFile(witnesses_json(report)).path()).value();
    for (const Witness& w : read) {
        const Replay replay = replay_witness(w, catalogue());
        EXPECT_EQ(replay.not_reproduced, "") << w.kernel;
        for (const KernelAnswer& a : replay.answers)
            EXPECT_EQ(a.kernel.starts_with("triangle.perspective-"), w.c.perspective) << a.kernel;
        if (!w.c.perspective) continue;
        EXPECT_EQ(replay.identity, IdentityVerdict::holds);
        EXPECT_EQ(replay.answers.size(), 6U);
        ++seen;
    }
    EXPECT_GT(seen, 5);
}

std::string refusal(const std::string& bytes) {
    const TemporaryFile file(bytes);
    const auto r = read_witnesses(file.path());
    EXPECT_FALSE(r) << bytes;
    if (r) return "";
    EXPECT_EQ(r.error().file, file.path());
    return r.error().message();
}

TEST(Witness, MalformedFilesAreRefused) {
    const std::string good =
        R"({"schema":1,"witnesses":[{"simplex":"triangle","vertices":[["0","0"],["1","0"],["0","1"]],"point":["0x1p-2","0.25"]}]})";
    EXPECT_EQ(read_witnesses(TemporaryFile(good).path()).value().size(), 1U);
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string s = good;
        return s.replace(s.find(from), from.size(), to);
    };
    EXPECT_NE(refusal("not json").find("JSON"), std::string::npos);
    EXPECT_NE(refusal(good.substr(0, 60)).find("JSON"), std::string::npos);
    EXPECT_NE(refusal(replaced("\"schema\":1", "\"schema\":99")).find("schema"), std::string::npos);
    EXPECT_NE(refusal(replaced("triangle", "pentagon")).find("pentagon"), std::string::npos);
    EXPECT_NE(refusal(replaced("\"0x1p-2\"", "\"nan\"")).find("point"), std::string::npos);
    EXPECT_NE(refusal(replaced("\"0x1p-2\"", "\"1e999\"")).find("point"), std::string::npos);
    EXPECT_NE(refusal(replaced("\"0x1p-2\",", "")).find("point"), std::string::npos);
    EXPECT_NE(refusal(replaced("[\"1\",\"0\"]", "[\"1\"]")).find("vertex 1"), std::string::npos);
    EXPECT_NE(refusal(replaced("\"witnesses\"", "\"others\"")).find("witnesses"), std::string::npos);
    EXPECT_NE(refusal("[]").find("schema"), std::string::npos);
    EXPECT_FALSE(read_witnesses("/nowhere/at/all.json"));
    // Nested so deeply that to copy it would take more than the stack.
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_NE(refusal(deep).find("JSON"), std::string::npos);
    for (const char* part : {"1,", "\"triangle\"", "\"0x1p-2\"", "[\"0x1p-2\",\"0.25\"]"}) {
        const bool comma = part[1] == ',';
        EXPECT_NE(refusal(replaced(part, comma ? deep + "," : deep)).find("JSON"), std::string::npos) << part;
    }
    // Perspective: depths are above zero, and only triangles have it.
    const std::string depths =
        R"({"schema":1,"witnesses":[{"simplex":"triangle","perspective":true,"vertices":[["0","0","1"],["1","0","2"],["0","1","3"]],"point":["0x1p-2","0.25"]}]})";
    EXPECT_TRUE(read_witnesses(TemporaryFile(depths).path()).value().front().c.perspective);
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string s = depths;
        return refusal(s.replace(s.find(from), from.size(), to));
    };
    EXPECT_NE(changed("\"2\"]", "\"0\"]").find("vertex 1: expected a depth w above 0"), std::string::npos);
    EXPECT_NE(changed("\"2\"]", "\"-1\"]").find("a depth w above 0"), std::string::npos);
    EXPECT_NE(changed(",\"2\"]", "]").find("vertex 1: expected 2 coordinates and w"), std::string::npos);
    EXPECT_NE(changed("true", "7").find("perspective: expected false, or true for a triangle"), std::string::npos);
    EXPECT_NE(changed("triangle", "tetrahedron").find("perspective: expected false"), std::string::npos);
}

}  // namespace
}  // namespace barycert::audit
