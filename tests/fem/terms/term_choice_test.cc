// Names and traits of the terms of a scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/fem/built_scene.h"

namespace orthodyn::term_choice_test {
namespace {

BuiltTestScene with(const std::string& keys) {
  return BuiltTestScene(R"(
mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
time: {end: 1}
)" + keys);
}

struct Declared {
  std::string name, keys;
  std::string traits;  // those that differ from a body without any term
};
void PrintTo(const Declared& d, std::ostream* os) { *os << d.name; }

// Traits of a clamped body with linear kinematics, in the order of struct Traits.
std::string traits_text(const Traits& t) {
  std::string text;
  const auto add = [&](bool differs, const char* what) {
    text += differs ? (text.empty() ? "" : " ") + std::string(what) : "";
  };
  add(!t.linear, "nonlinear");
  add(t.damping_matrix, "damping_matrix");
  add(t.time_dependent, "time_dependent");
  add(!t.conservative, "not_conservative");
  add(t.dissipative, "dissipative");
  add(t.loaded, "loaded");
  return text;
}

class DeclaredTraits : public testing::TestWithParam<Declared> {};

INSTANTIATE_TEST_SUITE_P(
    Terms, DeclaredTraits,
    testing::Values(
        Declared{"none", "", ""}, Declared{"gravity", "gravity: [0, 0, -9]", ""},
        Declared{"constant_load", "loads: [{surface: x1, force: [1, 0, 0]}]", "loaded"},
        Declared{"ramped_load", "loads: [{surface: x1, force: [1, 0, 0], factor: {type: ramp, end: 1}}]",
                 "time_dependent not_conservative loaded"},
        Declared{
            "constant_load_beside_a_ramped_one",
            "loads: [{surface: x1, force: [1, 0, 0], factor: {type: ramp, end: 1}}, {surface: y1, force: [1, 0, 0]}]",
            "time_dependent not_conservative loaded"},
        Declared{"point_load", "terms: [{type: point_load, nearest: [1, 1, 1], force: [1, 0, 0]}]", "loaded"},
        Declared{
            "swinging_point_load",
            "terms: [{type: point_load, nearest: [1, 1, 1], force: [1, 0, 0], factor: {type: sine, frequency: 1}}]",
            "time_dependent not_conservative loaded"},
        Declared{"load_by_a_formula", "loads: [{surface: x1, traction: [x*y, 0, 0]}]", "loaded"},
        Declared{"pressure", "terms: [{type: pressure, surface: x1, pressure: 1}]", "loaded"},
        Declared{"ramped_pressure", "terms: [{type: pressure, pressure: 1, factor: {type: ramp, end: 1}}]",
                 "time_dependent not_conservative loaded"},
        Declared{"pressure_that_follows", "terms: [{type: pressure, surface: x1, pressure: 1, follows: true}]",
                 "nonlinear not_conservative loaded"},
        Declared{"springs_in_place", "terms: [{type: spring, surface: x1, stiffness: 1}]", ""},
        Declared{"spring_to_an_anchor", "terms: [{type: spring, surface: x1, anchor: [2, 0, 0], stiffness: 1}]",
                 "nonlinear"},
        Declared{"dashpots_in_place", "terms: [{type: dashpot, surface: x1, coefficient: 1}]",
                 "damping_matrix not_conservative dissipative"},
        Declared{"ground_contact", "terms: [{type: ground_contact, stiffness: 1}]", "nonlinear"},
        Declared{"motion", "motions: [{nearest: [1, 1, 1], translation: [1, 0, 0], factor: {type: ramp, end: 1}}]",
                 "time_dependent not_conservative loaded"},
        Declared{"mass_damping", "damping: {mass: 1}", "not_conservative dissipative"},
        Declared{"stiffness_damping", "damping: {stiffness: 1}", "damping_matrix not_conservative dissipative"}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(DeclaredTraits, AreThoseOfTheForce) {
  EXPECT_EQ(traits_text(with(GetParam().keys).model().traits()), GetParam().traits);
}

// Order of summation, which determines the last digits of results: gravity, loads, terms.
TEST(TermNames, SayWhatEachIsAndOnWhat) {
  const auto scene = with(R"(
terms:
  - {type: spring, surface: x1, stiffness: 1}
  - {type: dashpot, surface: x1, coefficient: 1}
  - {type: ground_contact, stiffness: 1}
  - {type: point_load, surface: x1, force: [1, 0, 0]}
  - {type: pressure, surface: x1, pressure: 1}
  - {type: pressure, pressure: 1, follows: true}
loads: [{surface: x1, force: [1, 0, 0]}]
gravity: [0, 0, -9]
)");
  const std::vector<std::string> expected = {
      "gravity", "traction on x1", "springs",        "dashpots",
      "ground",  "point load",     "pressure on x1", "pressure on the whole outer surface"};
  const auto& terms = scene.model().parts().loads;
  ASSERT_EQ(terms.size(), expected.size());
  for (std::size_t k = 0; k < terms.size(); ++k) {
    EXPECT_EQ(terms[k]->name(), expected[k]);
    EXPECT_TRUE(terms[k]->description().starts_with(expected[k])) << terms[k]->description();
  }
  EXPECT_EQ(terms[2]->description(), "springs: 4 of 0.25 N/m");
  EXPECT_EQ(terms[1]->description(), "traction on x1: [1, 0, 0] N in total");
  EXPECT_EQ(terms[5]->description(), "point load: 4 nodes, [1, 0, 0] N in total");
  EXPECT_EQ(terms[6]->description(), "pressure on x1: dead, [-1, 0, 0] N in total");
  EXPECT_EQ(terms[7]->description(), "pressure on the whole outer surface: follows the surface");
}

}  // namespace
}  // namespace orthodyn::term_choice_test
