// Which text names what.
#include <gtest/gtest.h>

#include "mesh/sample/quantity/quantities.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

class QuantityNames : public ::testing::Test {
protected:
    QuantityNames() {
        const auto field = [](const std::string& name, int components, std::size_t entities) {
            return Field{name, components, std::vector<double>(static_cast<std::size_t>(components) * entities, 1.0)};
        };
        const std::size_t nodes = mesh.point_count(), cells = mesh.cell_count();
        mesh.point_fields = {field("T", 1, nodes), field("v", 3, nodes), field("E", 1, nodes), field("a,b", 2, nodes)};
        mesh.cell_fields = {field("E", 2, cells), field("w", 3, cells)};
    }

    std::string columns(const std::vector<std::string>& names) const {
        const auto sampler = Sampler::build(mesh, names);
        if (!sampler) return sampler.error().message();
        std::string all;
        for (const std::string& c : sampler->columns()) all += (all.empty() ? "" : " ") + c;
        return all;
    }

    Mesh mesh = box(3, {1, 1, 1});
};

TEST_F(QuantityNames, HaveTheirColumns) {
    EXPECT_EQ(columns({"v.x", "v.2"}), "v.x v.2");
    EXPECT_EQ(columns({"v.x,v.2"}), "v.x v.2");
    EXPECT_EQ(columns({"|v|,|w|"}), "|w| |v|") << "what is computed at points comes last";
    EXPECT_EQ(columns({"grad(T),grad(E)"}), "grad(T).0 grad(T).1 grad(T).2 grad(E).0 grad(E).1 grad(E).2");
    EXPECT_EQ(columns({"grad(v).8,grad(v).y"}), "grad(v).8 grad(v).y");
    EXPECT_EQ(columns({"mean(E)"}), "mean(E).0 mean(E).1") << "that of the cells";
    EXPECT_EQ(columns({"mean(cell:E).y", "cell:E.x", "E.x"}), "mean(cell:E).y E.x cell:E.x");
}

// Bindings keep fields apart from the geometry: names need no more of a mesh than choose_fields says.
TEST_F(QuantityNames, AreChosenFromFieldsAlone) {
    const Locator locator = Locator::build(mesh).value();
    Mesh fields;
    fields.dimension = mesh.dimension;
    fields.point_fields = mesh.point_fields;
    fields.cell_fields = mesh.cell_fields;
    const std::vector<double> point{0.5, 0.25, 0.125};
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{}, {"T", "w"}, {"|v|,grad(T)"}, {"mean(E)", "v.x"}}) {
        const Sampler own = Sampler::build(mesh, names).value();
        const Sampler chosen = Sampler::build(locator, choose_fields(fields, names).value()).value();
        EXPECT_EQ(chosen.columns(), own.columns());
        EXPECT_EQ(chosen.sample(point)->values, own.sample(point)->values);
    }
    EXPECT_NE(choose_fields(fields, {"none"}).error().message().find("\"none\""), std::string::npos);
    EXPECT_FALSE(choose_fields(fields, {"T", "T"}));
}

TEST_F(QuantityNames, OfFieldsGoBefore) {
    for (const std::string name : {"|v|", "grad(T)", "v.x", "mean(E)"}) {
        mesh.point_fields.push_back({name, 1, std::vector<double>(mesh.point_count(), 42)});
        EXPECT_EQ(columns({name}), name);
        const std::vector<double> point{0.5, 0.25, 0.125};
        EXPECT_EQ(Sampler::build(mesh, {name})->sample(point)->values, std::vector<double>{42}) << name;
    }
    EXPECT_EQ(columns({"||v||"}), "||v||") << "the length of the field |v|";
    EXPECT_EQ(columns({"|a,b|"}), "|a,b|");
    EXPECT_EQ(columns({"a,b.y"}), "a,b.y");
}

TEST_F(QuantityNames, ThatMeanNothingAreRefused) {
    const auto refused = [&](const std::string& name, const std::string& says) {
        const std::string message = columns({name});
        EXPECT_NE(message.find(says), std::string::npos) << name << " says " << message;
    };
    refused("|u|", "no field of that name: found \"u\"");
    refused("grad()", "no field of that name: found \"grad()\"");
    refused("||", "no field of that name: found \"||\"");
    refused("|", "no field of that name: found \"|\"");
    refused("v.q", "no field of that name: found \"v.q\"");
    refused("v.00", "no field of that name");
    refused("v.-1", "no field of that name");
    refused("v.99999999999999999999", "no field of that name");
    refused("v.3", "no such component in \"v.3\": expected 0 to 2, found 3");
    refused("T.y", "no such component in \"T.y\": expected 0 to 0, found 1");
    refused("grad(w)", "the gradient of what is constant in each cell");
    refused("grad(grad(T))", "the gradient of what is constant in each cell");
    refused("mean(T)", "the mean over cells of what is not a field of cells");
    refused("grad(|v|)", "nothing is made of a length at points");
    refused("|v|.x", "nothing is made of a length at points");
    refused("v,v.0", "two columns have the same name: found \"v.0\"");
    refused("v.x,point:v.0", "a column is chosen twice: found \"point:v.0\"");
    refused("|v|,T,|v|", "a column is chosen twice: found \"|v|\"");
    refused("grad(T),|T|,grad(U)", "no field of that name: found \"U\"");
    refused(std::string(100000, '|'), "no field of that name");
}

TEST_F(QuantityNames, CanBeRenamedWithin) {
    using sample::with_other_name;
    EXPECT_EQ(with_other_name("T", "T", "T@2"), "T@2");
    EXPECT_EQ(with_other_name("|grad(T)|.x", "T", "T@2"), "|grad(T@2)|.x");
    EXPECT_EQ(with_other_name("mean(cell:T)", "T", "T@2"), "mean(cell:T@2)");
    EXPECT_EQ(with_other_name("grad(T)", "grad(T)", "q"), "q");
    EXPECT_EQ(with_other_name("grad(TT)", "T", "q"), std::nullopt);
    EXPECT_EQ(with_other_name("grad(T", "T", "q"), std::nullopt);
}

}  // namespace
}  // namespace barycert::testing
