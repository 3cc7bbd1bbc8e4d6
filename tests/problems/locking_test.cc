// The estimated mesh error of locking elements: thin cells in bending, and nearly incompressible or nearly inextensible
// materials. Compared with true errors from finer meshes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/mesh/mesh.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/error_estimate/locking_check.h"
#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn::locking_test {
namespace {

// Estimated and true errors of the energy and of a probe's displacement of a body in equilibrium.
struct Body {
  const char* name;
  std::string scene;  // with {cells} and {order}
  std::string coarse, fine;
  int order;
  Vec3 probe;
  int component;
};

std::string with(std::string text, const std::string& cells, int order) {
  const auto put = [&](const std::string& what, const std::string& value) {
    text.replace(text.find(what), what.size(), value);
  };
  put("CELLS", cells);
  put("ORDER", std::to_string(order));
  return text;
}

std::string block(const std::string& size, const std::string& material, const std::string& rest,
                  const char* elements = "tetrahedra") {
  return "analysis: static\nelasticity: {kinematics: linear}\nmesh: {type: box, size: " + size +
         ", cells: CELLS, order: ORDER, elements: " + elements + "}\nmaterials: {m: " + material + "}\n" + rest;
}

std::string isotropic(double nu) { return fmt::format("{{type: isotropic, density: 1000, young: 1e9, nu: {}}}", nu); }

const char* const kSpruce = "{type: preset, name: sitka_spruce}";
const char* const kBent = "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -1]}]\n";
const char* const kPressed =
    "clamps: [{surface: x0}, {surface: x1}, {surface: y0}, {surface: y1}]\nloads: [{surface: z1, traction: [0, 0, "
    "-1]}]\n";
const char* const kPlaneStrain =
    "clamps: [{surface: x0}, {surface: y0, components: [y]}, {surface: y1, components: [y]}]\n"
    "loads: [{surface: x1, force: [0, 0, -1]}]\n";

const char* const kDisplacement = "regions: {all: {material: m, formulation: displacement}}\n";

std::vector<Body> bodies() {
  const Vec3 tip(1, 0.1, 0.1), middle(0.2, 0.15, 0), end(0.5, 0.1, 0.4);
  return {
      {"a plate 10 to 1", block("[0.4, 0.3, 0.04]", kSpruce, kPressed), "[8, 6, 1]", "[16, 12, 3]", 2, middle, 2},
      {"a plate 100 to 1", block("[0.4, 0.3, 0.004]", kSpruce, kPressed), "[8, 6, 1]", "[24, 18, 1]", 2, middle, 2},
      {"a plate 200 to 1", block("[0.4, 0.3, 0.002]", kSpruce, kPressed), "[8, 6, 1]", "[24, 18, 1]", 2, middle, 2},
      {"a plate 100 to 1, hexahedra", block("[0.4, 0.3, 0.004]", kSpruce, kPressed, "hexahedra"), "[8, 6, 1]",
       "[24, 18, 2]", 2, middle, 2},
      {"a plate 200 to 1, hexahedra", block("[0.4, 0.3, 0.002]", kSpruce, kPressed, "hexahedra"), "[8, 6, 1]",
       "[24, 18, 2]", 2, middle, 2},
      {"a beam 10 to 1", block("[1, 0.1, 0.1]", isotropic(0.3), kBent), "[10, 2, 2]", "[16, 2, 2]", 1, tip, 2},
      {"a beam 10 to 1, quadratic", block("[1, 0.1, 0.1]", kSpruce, kBent), "[8, 1, 1]", "[20, 3, 3]", 2, tip, 2},
      {"nu 0.49", block("[0.5, 0.1, 0.4]", isotropic(0.49), kPlaneStrain), "[5, 1, 4]", "[14, 1, 11]", 1, end, 2},
      {"nu 0.499", block("[0.5, 0.1, 0.4]", isotropic(0.499), kPlaneStrain), "[5, 1, 4]", "[14, 1, 11]", 1, end, 2},
      {"nu 0.4999", block("[0.5, 0.1, 0.4]", isotropic(0.4999), kPlaneStrain), "[5, 1, 4]", "[14, 1, 11]", 1, end, 2},
      {"nu 0.4999, quadratic", block("[0.5, 0.1, 0.4]", isotropic(0.4999), std::string(kPlaneStrain) + kDisplacement),
       "[4, 1, 3]", "[16, 1, 12]", 2, end, 2}};
}

class Locking : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Locking, testing::ValuesIn(bodies()), [](const auto& body) {
  std::string name;
  for (const char c : std::string(body.param.name)) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST_P(Locking, IsSeenByFinerElements) {
  const Body& body = GetParam();
  const auto solve = [&](const std::string& cells, int order) {
    auto setup = std::make_unique<orthodyn::Setup>(set_up(Config::from_text(with(body.scene, cells, order))));
    const Vector q = equilibrium(setup->scene, setup->built);
    return std::pair{std::move(setup), q};
  };
  const auto [fine, fine_q] = solve(body.fine, 2);
  const auto [coarse, q] = solve(body.coarse, body.order);
  const auto moved = [&](const orthodyn::Setup& setup, const Vector& free) {
    const FemModel& model = *setup.built.model;
    const NodalExpansion nodal(model.parts(), 0, free, Vector::Zero(free.size()));
    return nodal.u(body.component, nearest_node(model.parts().mesh, body.probe));
  };
  const FemModel& model = *coarse->built.model;
  const State state{coarse->scene.time.end, q, Vector::Zero(q.size())};
  const auto found =
      estimate_mesh_error(coarse->scene, model, state, false, {}, {nearest_node(model.parts().mesh, body.probe)});
  ASSERT_TRUE(found.error.by_finer_elements);
  const double computed = moved(*coarse, q), error = moved(*fine, fine_q) - computed;
  const double energy = model.evaluate("energy.elastic", state)[0];
  const double all = fine->built.model->evaluate("energy.elastic", {0, fine_q, Vector::Zero(fine_q.size())})[0];
  const double told = found.displacements[0][body.component];
  const double of_probe = (told / (computed + told)) / (error / (computed + error));
  const double of_energy = found.error.relative / (1 - energy / all);
  for (const double effectivity : {of_probe, of_energy}) {
    EXPECT_GT(effectivity, 0.6);
    EXPECT_LT(effectivity, 1.5);
  }
}

TEST(LockingFrequencies, AreSeenByFinerElements) {
  const auto analyse = [](const std::string& cells, const std::string& more) {
    const orthodyn::Setup setup =
        set_up(Config::from_text("mesh: {type: box, size: [0.4, 0.3, 0.003], cells: " + cells +
                                 ", elements: tetrahedra}\nmaterials: {m: " + kSpruce + "}\ntime: {end: 1}\n" + more));
    const ModalAnalysis analysis(setup, 9, false);
    std::vector<std::pair<double, double>> out;
    for (std::size_t k = static_cast<std::size_t>(analysis.modes().zeros); k < 9; ++k)
      out.emplace_back(analysis.modes().modes[k].frequency(), analysis.mesh_errors()[k]);
    return out;
  };
  for (const std::string more : {"clamps: [{surface: x0}, {surface: x1}, {surface: y0}, {surface: y1}]\n"}) {
    SCOPED_TRACE(more);
    const auto fine = analyse("[28, 21, 1]", more), coarse = analyse("[8, 6, 1]", more);
    for (std::size_t k = 0; k < 3; ++k) {
      const double error = coarse[k].first / fine[k].first - 1;
      EXPECT_GT(coarse[k].second / error, 0.6);
      EXPECT_LT(coarse[k].second / error, 1.5);
    }
  }
}

std::string locking_risk_of(const std::string& scene, bool by_finer_elements) {
  const orthodyn::Setup setup = set_up(Config::from_text(scene));
  const Vector q = equilibrium(setup.scene, setup.built);
  return locking_risk(*setup.built.model, {setup.scene.time.end, q, Vector::Zero(q.size())}, by_finer_elements);
}

TEST(BlindSpot, IsNamedWhereRecoveredStressesCannotSee) {
  const std::string plate = block("[0.4, 0.3, 0.003]", kSpruce, kPressed),
                    beam = block("[1, 0.1, 0.1]", kSpruce, kBent);
  EXPECT_NE(locking_risk_of(with(plate, "[8, 6, 1]", 2), false).find("times as wide as thick, and the body bends"),
            std::string::npos);
  EXPECT_EQ(locking_risk_of(with(plate, "[8, 6, 1]", 2), true), "");  // the estimate detects it
  EXPECT_EQ(locking_risk_of(with(beam, "[10, 1, 1]", 2), false), "");
  // In tension nothing locks.
  const std::string pulled = block("[0.4, 0.3, 0.003]", isotropic(0.3),
                                   "clamps: [{surface: x0, components: [x]}, {surface: y0, components: [y]}, {surface: "
                                   "z0, components: [z]}]\nloads: [{surface: x1, traction: [1, 0, 0]}]\n");
  EXPECT_EQ(locking_risk_of(with(pulled, "[8, 6, 1]", 2), false), "");
}

TEST(BlindSpot, IsNamedOfLawsThatAreFarStifferInOneWay) {
  const auto body = [](const std::string& material) { return block("[1, 0.1, 0.1]", material, kBent); };
  EXPECT_NE(locking_risk_of(with(body(isotropic(0.4999)), "[5, 1, 1]", 1), false).find("against a change of volume"),
            std::string::npos);
  EXPECT_EQ(locking_risk_of(with(body(isotropic(0.4999)), "[5, 1, 1]", 1), true), "");
  EXPECT_EQ(locking_risk_of(with(body(isotropic(0.3)), "[5, 1, 1]", 1), false), "");
  const char* const fibres =
      "{type: orthotropic, density: 400, young: [1e12, 1e8, 1e8], nu12: 0.3, nu23: 0.3, nu13: 0.3, g12: 5e7, g23: 4e7, "
      "g13: 5e7}";
  for (const bool by_finer : {false, true})
    EXPECT_NE(locking_risk_of(with(body(fibres), "[5, 1, 1]", 2), by_finer).find("along its stiffest direction"),
              std::string::npos);
}

}  // namespace
}  // namespace orthodyn::locking_test
