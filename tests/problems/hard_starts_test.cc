// Extreme initial shapes: collapsed, mirrored, random. The energy lost equals the dissipation, all values stay finite,
// and no exception is thrown. Returning to the rest shape is not required: inverted equilibria are physical.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::hard_starts_test {
namespace {

using Place = std::function<Vec3(Random&, const Vec3& X)>;

struct Start {
  std::string name;
  Place place;
};
void PrintTo(const Start& s, std::ostream* os) { *os << s.name; }

const Vec3 kCenter{1, 0.5, 0.5};

Place in_box() {
  return [](Random& r, const Vec3&) { return Vec3(r.between(0, 2), r.between(0, 1), r.between(0, 1)); };
}

const Start kStarts[] = {
    {"point", [](Random&, const Vec3&) { return kCenter; }},
    {"almost_a_point", [](Random& r, const Vec3&) { return Vec3(kCenter + 1e-9 * r.vector()); }},
    {"line", [](Random&, const Vec3& X) { return Vec3(X[0], 0.5, 0.5); }},
    {"plane", [](Random&, const Vec3& X) { return Vec3(X[0], X[1], 0.5); }},
    {"mirrored", [](Random&, const Vec3& X) { return Vec3(2 - X[0], X[1], X[2]); }},
    {"random_1", in_box()},
    {"random_2", in_box()},
    {"random_3", in_box()},
};

void expect_to_lose_what_damping_takes(const Start& start, const std::string& mesh, const std::string& material,
                                       const std::string& integrator) {
  BuiltTestScene scene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 1], cells: [2, 1, 1], {}}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
damping: {{mass: 1}}
integrator: {{type: {}, rtol: 1e-5, max_order: 2}}
time: {{end: 10}}
)",
                                   mesh, material, kTurnedAxes, integrator));
  Random random(static_cast<unsigned>(start.name.back()));
  scene.built.initial.q = scene.dofs([&](const Vec3& X) { return Vec3(start.place(random, X) - X); });
  const double initial = total_energy(scene, scene.built.initial);
  const auto method = scene.scene.integrator->make(scene.model(), task_of(scene.scene, scene.built));
  EnergyMeter energy(scene.model(), *method);
  const auto outcome =
      run(scene.model(), *method, scene.built.initial, {scene.scene.time.end, {}, false}, {&energy}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  // Each oscillation adds a relative energy error of 1e-5^(2/3) = 5e-4, the error of the state. Damping leaves about
  // ten oscillations.
  EXPECT_TRUE(std::isfinite(energy.last().balance()));
  EXPECT_LE(energy.drift(), 5e-3 * initial);
  // Damping leaves exp(-10) of the vibration; the remainder is the elastic energy of inverted elements.
  EXPECT_GT(energy.last().dissipated, 0.5 * initial);
}

std::string name_of(const testing::TestParamInfo<std::tuple<Start, std::string>>& tested) {
  return std::get<0>(tested.param).name + "_" + std::get<1>(tested.param);
}

class HardStart : public testing::TestWithParam<std::tuple<Start, std::string>> {};
INSTANTIATE_TEST_SUITE_P(Starts, HardStart,
                         testing::Combine(testing::ValuesIn(kStarts), testing::Values("cvode_bdf", "ida_bdf")),
                         name_of);

TEST_P(HardStart, LosesWhatDampingTakesAndStaysFinite) {
  const auto& [start, integrator] = GetParam();
  for (const double ratio : {1.0, 10.0, 100.0}) {
    SCOPED_TRACE(ratio);
    expect_to_lose_what_damping_takes(start, "split: six, order: 1", fibre_material(ratio), integrator);
  }
}

class HardStartOfQuadraticElements : public testing::TestWithParam<std::tuple<Start, std::string>> {};
INSTANTIATE_TEST_SUITE_P(Starts, HardStartOfQuadraticElements,
                         testing::Combine(testing::ValuesIn(kStarts),
                                          testing::Values("tetrahedra", "hexahedra", "wedges")),
                         name_of);

TEST_P(HardStartOfQuadraticElements, LosesWhatDampingTakesAndStaysFinite) {
  const auto& [start, elements] = GetParam();
  for (const std::string& material :
       {fibre_material(10), std::string("{type: isotropic, density: 1, young: 1, nu: 0.49}")}) {
    SCOPED_TRACE(material);
    expect_to_lose_what_damping_takes(start, "elements: " + elements, material, "cvode_bdf");
  }
}

}  // namespace
}  // namespace orthodyn::hard_starts_test
