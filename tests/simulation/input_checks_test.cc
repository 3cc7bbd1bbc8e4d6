// Errors of unit and magnitude in scenes: the input, and words that the message must contain.
#include "lib/simulation/preflight/input_checks/input_checks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <map>

#include "lib/core/spelling.h"
#include "lib/simulation/run/setup.h"
#include "tests/scene/scenes.h"

namespace orthodyn::input_checks_test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// A wooden cantilever that bends a little under its weight and a force at its end.
const std::string kCantilever = R"(mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}
materials:
  wood: {type: orthotropic_stable, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu: 0.3}
regions: {body: {material: wood}}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
loads: [{surface: x1, force: [0, 0, -100]}]
damping: {stiffness: 1e-5}
time: {end: 0.5}
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
integrator: {type: tr_bdf2, rtol: 1e-4}
)";

// The findings before a scene runs: warnings, or the error that rejects it.
struct Findings {
  bool refused = false;
  std::string words;
};

Findings findings_of(const std::string& scene) {
  try {
    Findings findings;
    for (const auto& warning : set_up(Config::from_text(scene, "scene.yaml")).built.warnings)
      findings.words += warning + "\n";
    return findings;
  } catch (const ConfigError& e) {
    return {true, e.what()};
  }
}

// Lumped masses of a cube of one linear cell lie in its corners: its moments of inertia are m a^2/2 instead of m a^2/6.
TEST(InputChecks, AMomentOfInertiaOfLumpedMassesIsToldWhereTheBodyTurns) {
  const auto cube = [](const std::string& rest) {
    return findings_of(
               "mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}\n"
               "materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}\ntime: {end: 1}\n" +
               rest)
        .words;
  };
  const auto reported = HasSubstr("moment of inertia +200 % off");
  EXPECT_THAT(cube("initial: {spin: [0, 0, 1]}"), reported);
  EXPECT_THAT(cube("terms: [{type: point_load, nearest: [1, 1, 1], force: [100, 0, 0]}]"), reported);
  EXPECT_THAT(cube("initial: {velocity: [0, 0, 1]}"), testing::Not(reported));
  EXPECT_THAT(cube("initial: {spin: [0, 0, 1]}\nmass: consistent"), testing::Not(reported));
  EXPECT_THAT(cube("initial: {spin: [0, 0, 1]}\nterms: [{type: spring, nearest: [0, 0, 0], stiffness: 1}]"),
              testing::Not(reported));
  EXPECT_THAT(cube("initial: {spin: [0, 0, 1]}\nclamps: [{surface: x0}]"), testing::Not(reported));
}

TEST(InputChecks, AGivenCentreOfMassFarFromTheBodyIsNamed) {
  const auto body = [](const std::string& center) {
    return findings_of(fmt::format("mesh: {{type: box, size: [1, 0.1, 0.1], cells: [1, 1, 1], order: 1}}\n"
                                   "materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}\n"
                                   "regions:\n  body: {{material: m, rigid: {{mass: 10, center: {}, inertia: [1, 1, "
                                   "1]}}}}\ntime: {{end: 1}}\n",
                                   center))
        .words;
  };
  EXPECT_THAT(body("[0.5, 0.05, 0.05]"), Not(HasSubstr("centre of mass")));
  EXPECT_THAT(body("[1.5, 0.05, 0.05]"), Not(HasSubstr("centre of mass")));
  EXPECT_THAT(body("[500, 50, 50]"), HasSubstr("regions.body: rigid: the centre of mass, [500, 50, 50]"));
}

TEST(InputChecks, ANearlyIncompressibleMaterialIsNotForLinearTetrahedra) {
  const auto block = [](const std::string& mesh) {
    return findings_of("mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 2], " + mesh +
                       "}\nmaterials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.4999}}\n"
                       "clamps: [{surface: z0}]\ngravity: [0, 0, -9.81]\nanalysis: static\n")
        .words;
  };
  EXPECT_THAT(block("order: 1"), HasSubstr("tetrahedra are then far too stiff (locking)"));
  for (const char* other : {"order: 2", "elements: hexahedra, order: 1", "elements: wedges, order: 1"})
    EXPECT_THAT(block(other), Not(HasSubstr("locking"))) << other;
}

TEST(InputChecks, ANearlyIncompressibleMaterialNeedsTheMixedFormulation) {
  const auto block = [](const std::string& region, const std::string& more = "") {
    return findings_of(
               "mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 2], elements: hexahedra_27}\n"
               "materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.4999}}\n"
               "regions: {body: {material: m" +
               region + "}}\nclamps: [{surface: z0}]\ngravity: [0, 0, -9.81]\nanalysis: static\n" + more)
        .words;
  };
  EXPECT_THAT(block(""), Not(HasSubstr("nearly incompressible")));
  EXPECT_THAT(block(", formulation: displacement"), HasSubstr("remove formulation: displacement"));
  EXPECT_THAT(block("", "elasticity: {corotation: warped}\n"), HasSubstr("remove elasticity.corotation: warped"));
}

TEST(InputChecks, OfRelaxationAreNamed) {
  const auto bar = [](const std::string& time, const std::string& more, const std::string& shares = "share: 0.3",
                      double nu = 0.3) {
    return findings_of(fmt::format(R"(
mesh: {{type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e9, nu: {}, viscoelastic: [{{time: {}, {}}}]}}}}
clamps: [{{surface: x0}}]
{}
)",
                                   nu, time, shares, more))
        .words;
  };
  const std::string slow = "loads: [{surface: x1, force: [0, 0, -1], factor: {type: smooth_step, end: 10}}]\n",
                    sudden = "loads: [{surface: x1, force: [0, 0, -1]}]\n", run = "time: {end: 1000}\n";
  EXPECT_EQ(bar("100", slow + run), "");
  EXPECT_THAT(bar("1e6", slow + run), HasSubstr("hardly anything relaxes. Is it in another unit?"));
  EXPECT_THAT(bar("1e6", sudden + run + "start: equilibrium\n"), HasSubstr("everything has relaxed"));
  EXPECT_THAT(bar("100", sudden + "analysis: static\n"), HasSubstr("uses the relaxed stiffness"));
  EXPECT_THAT(bar("100", sudden + run), HasSubstr("the loads act suddenly and start vibrations"));
  EXPECT_EQ(bar("100", sudden + run + "damping: {stiffness: 1e-2}\n"), "");
  EXPECT_THAT(bar("100", slow + run, "share: 0.3", 0.499), HasSubstr("give `deviatoric` shares"));
  EXPECT_EQ(bar("100", slow + run, "deviatoric: 0.3", 0.499), "");
  // Nearly incompressible once the shear modulus has relaxed.
  EXPECT_THAT(
      bar("100", slow + run + "regions: {all: {material: m, formulation: displacement}}\n", "deviatoric: 0.99", 0.4),
      HasSubstr("remove formulation: displacement"));
}

TEST(InputChecks, OfChangesAreNamed) {
  const auto board = [](const std::string& coefficient, const std::string& change) {
    return findings_of(fmt::format(R"(
analysis: static
mesh: {{type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e9, nu: 0.3, expansion: {{{}}}}}}}
clamps: [{{surface: x0}}]
{}
)",
                                   coefficient, change))
        .words;
  };
  EXPECT_EQ(board("moisture: 0.002", "moisture: {change: -10}"), "");
  EXPECT_THAT(board("moisture: 0.002", "moisture: {change: -60}"), HasSubstr("above the fibre saturation"));
  EXPECT_THAT(board("moisture: 0.2", "moisture: {change: -10}"), HasSubstr("coefficients of expansion are strains"));
  EXPECT_EQ(board("temperature: 1e-5", "temperature: {change: 100}"), "");
  EXPECT_THAT(board("temperature: 1e-5", "temperature: {change: 293}"),
              HasSubstr("looks like an absolute temperature"));
  EXPECT_THAT(board("temperature: 0.02", "temperature: {change: 100}"), HasSubstr("strains material 'm' by 2"));
}

// With linear kinematics a rotated body grows by 1/cos of the angle.
TEST(InputChecks, AFreeBodyThatTurnsIsNotForLinearKinematics) {
  const auto spun = [](double spin, const std::string& kinematics) {
    return findings_of(fmt::format("mesh: {{type: box, size: [1, 1, 1], cells: [2, 2, 2]}}\n"
                                   "materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}\n"
                                   "mass: consistent\ntime: {{end: 2}}\ninitial: {{spin: [0, 0, {}]}}\n"
                                   "elasticity: {{kinematics: {}}}\n",
                                   spin, kinematics))
        .words;
  };
  EXPECT_THAT(spun(0.2, "linear"), HasSubstr("it turns by about 0.4 rad"));
  EXPECT_THAT(spun(0.2, "corotational"), testing::Not(HasSubstr("turns by")));
  EXPECT_THAT(spun(0.04, "linear"), testing::Not(HasSubstr("turns by")));
}

// A steady load on a free body, in `loads` or `terms`; a spring may hold the body.
TEST(InputChecks, ASteadyPushOfAFreeBodyIsNamedWhateverSectionItStandsIn) {
  const auto pushed = [](const std::string& rest) {
    return findings_of(
               "mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}\n"
               "materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}\nmass: consistent\n"
               "time: {end: 1}\n" +
               rest)
        .words;
  };
  const auto reported = HasSubstr("nothing holds the body");
  EXPECT_THAT(pushed("loads: [{surface: x1, force: [0, 0, 10]}]"), reported);
  EXPECT_THAT(pushed("terms: [{type: pressure, surface: z0, pressure: 100}]"), reported);
  EXPECT_THAT(pushed("terms: [{type: point_load, nearest: [1, 0, 0], force: [0, 0, 10]}]"), reported);
  EXPECT_THAT(pushed("terms: [{type: point_load, nearest: [1, 0, 0], force: [0, 0, 10]}, {type: spring, nearest: [0, "
                     "0, 0], stiffness: 100}]"),
              testing::Not(reported));
}

struct Mistake {
  std::string name, from, to;
  bool refused;
  std::string says;
};

constexpr bool kRefused = true, kWarned = false;

class InputChecks : public testing::TestWithParam<Mistake> {};

TEST_P(InputChecks, AreNamed) {
  const Mistake& mistake = GetParam();
  const Findings findings = findings_of(replaced(kCantilever, mistake.from, mistake.to));
  EXPECT_EQ(findings.refused, mistake.refused) << findings.words;
  EXPECT_THAT(findings.words,
              AllOf(HasSubstr(mistake.says), AnyOf(HasSubstr("scene.yaml:"), HasSubstr("region body:"))));
}

const std::string kLoad = "loads: [{surface: x1, force: [0, 0, -100]}]";
const std::string kTime = "time: {end: 0.5}";
const std::string kYoung = "[10.8 GPa, 0.84 GPa, 0.46 GPa], nu: 0.3";
const std::string kWood = "{type: orthotropic_stable, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu: 0.3}";
const std::string kRtol = "rtol: 1e-4";

const std::string kOutput = "output: {probes: {tip: {at: [1, 0.05, 0.05]}}}\nintegrator: {type: tr_bdf2, rtol: 1e-4}\n";

std::string load_with(const std::string& factor) {
  return "loads: [{surface: x1, force: [0, 0, -100], factor: " + factor + "}]";
}

INSTANTIATE_TEST_SUITE_P(
    Materials, InputChecks,
    testing::Values(
        Mistake{"moduli_in_gpa", kYoung, "[10.8, 0.84, 0.46], nu: 0.3", kRefused, "is the unit of the moduli missing"},
        Mistake{"moduli_in_mpa", kYoung, "[10800, 840, 460], nu: 0.3", kWarned, "is the unit of the moduli missing"},
        Mistake{"one_unit_for_three", kYoung, "[10.8 GPa, 0.84, 0.46], nu: 0.3", kRefused, "unit missing: '0.84'"},
        Mistake{"isotropic_modulus_in_gpa", kWood, "{type: isotropic, density: 450, young: 11, nu: 0.3}", kRefused,
                "the stiffness is at most"},
        Mistake{"a_shear_modulus_without_its_unit", kWood,
                "{type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.3, nu23: 0.3, nu13: "
                "0.3, g12: 0.69, g23: 0.03 GPa, g13: 0.6 GPa}",
                kWarned, "does one of them lack its unit"},
        Mistake{"strengths_in_mpa", "0.46 GPa], nu: 0.3",
                "0.46 GPa], nu: 0.3, strength: {tension: [70, 2.6, 2.6], compression: [38.7, 4, 4], shear: [7.9, 1.4, "
                "7.9]}",
                kWarned, "its strength of 1.4 Pa"},
        Mistake{"density_in_g_per_cm3", "450", "0.45", kWarned, "Is it in g/cm^3?"},
        Mistake{"density_in_t_per_m3_as_0_4", "450", "0.4", kWarned, "faster than in any solid"},
        Mistake{"density_in_t_per_mm3", "450", "4.5e-10", kWarned, "Is it in t/mm^3"},
        Mistake{"density_in_g_per_m3", "450", "450000", kWarned,
                "beyond that of any metal: is it in g/m^3? Then write 450"},
        Mistake{"density_in_kg_per_cm3", "450", "450 g/cm^3", kWarned,
                "beyond that of any metal: is it 450 kg/m^3, or 0.45 g/cm^3?"},
        Mistake{"a_modulus_in_mpa_beside_gpa", "0.46 GPa", "0.46 MPa", kWarned,
                "E3 = 0.46 MPa is 1,826 times less than E2 = 0.84 GPa: is its unit GPa, too?"},
        Mistake{"a_modulus_in_tpa", "10.8 GPa", "10.8 TPa", kWarned, "E1 = 10.8 TPa is 12,857 times more than E2"},
        Mistake{"an_isotropic_modulus_in_tpa", kWood, "{type: isotropic, density: 450, young: 10.8 TPa, nu: 0.3}",
                kWarned, "are beyond those of diamond"},
        Mistake{"one_modulus_in_mpa_and_none_told", "[10.8 GPa, 0.84 GPa", "[10800, 0.84 GPa", kRefused,
                "write '10800 MPa', or '10800 Pa'"},
        Mistake{"a_decimal_comma", "[10.8 GPa", "['10,8 GPa'", kRefused, "with a decimal comma; write '10.8 GPa'"},
        Mistake{"a_unit_in_other_letters", "0.46 GPa", "0.46 Gpa", kRefused, "did you mean 'GPa'?"},
        Mistake{"oblique_directions", "{material: wood}",
                "{material: wood, axes: {first: [1, 1, 0], second: [0, 1, 0]}}", kWarned,
                "'second' is not normal to 'first' (angle 45 deg): axis 2 is the part of 'second' normal to 'first', "
                "[-0.7"},
        Mistake{"poisson_in_per_cent", "nu: 0.3", "nu: 30", kRefused, "found 30"},
        Mistake{"poisson_of_a_half", "nu: 0.3", "nu: 0.5", kRefused, "0.5"},
        Mistake{"angle_in_degrees", "{material: wood}",
                "{material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 30}}", kRefused,
                "'30 deg' or '30 rad'"},
        Mistake{"unit_of_another_dimension", "450", "450 kg", kRefused, "a mass (kg)"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Lengths, InputChecks,
    testing::Values(Mistake{"a_body_in_mm", "[1, 0.1, 0.1]", "[1000, 100, 100]", kWarned, "the body is 1000 m long"},
                    Mistake{"a_hundred_metres_of_wood", "[1, 0.1, 0.1]", "[100, 10, 10]", kWarned, "is it meant in mm"},
                    Mistake{"a_body_scaled_twice", "[1, 0.1, 0.1]", "[1e-7, 1e-8, 1e-8]", kRefused, "scaled twice"},
                    Mistake{"a_probe_in_mm", "[1, 0.05, 0.05]", "[1000, 50, 50]", kWarned,
                            "the probe 'tip' is 1e+03 m outside"},
                    Mistake{"a_clamp_far_outside", "{surface: x0}", "{surface: x0}, {nearest: [100, 0, 0]}", kWarned,
                            "clamps.1.nearest: the point is 99 m outside"},
                    Mistake{"a_point_load_far_outside", kLoad,
                            "terms: [{type: point_load, nearest: [500, 0, 0], force: [0, 0, -1]}]", kWarned,
                            "terms.0.nearest: the point is 499 m outside"},
                    Mistake{"a_box_of_clamps_in_mm", "{surface: x0}", "{box: {min: [100, 0, 0], max: [200, 100, 100]}}",
                            kRefused, "selects no node"},
                    Mistake{"a_clamp_twice", "{surface: x0}", "{surface: x0}, {surface: x0}", kWarned,
                            "clamps.1: is the same clamp as clamps.0"},
                    Mistake{"a_plane_of_clamps_in_mm", "{surface: x0}",
                            "{plane: {point: [1000, 0, 0], normal: [1, 0, 0]}}", kRefused, "selects no node"},
                    Mistake{"a_box_in_mm_that_holds_all", "{surface: x0}",
                            "{box: {min: [0, 0, 0], max: [100, 100, 100]}}", kRefused, "all nodes are clamped"},
                    Mistake{"one_length_in_mm", "[1, 0.1, 0.1]", "[1000 mm, 100, 100]", kRefused, "write '100 mm'"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Loads, InputChecks,
    testing::Values(
        Mistake{"gravity_in_mm", "-9.81", "-9810", kWarned, "is the gravity of the earth in mm/s^2"},
        Mistake{"gravity_in_cm", "-9.81", "-981", kWarned, "is the gravity of the earth in cm/s^2"},
        Mistake{"gravity_of_another_unit", "-9.81", "-98100", kWarned, "times the gravity of the earth"},
        Mistake{"gravity_upwards", "-9.81", "9.81", kWarned, "gravity points up, along +z"},
        Mistake{"gravity_as_a_number", "[0, 0, -9.81]", "9.81", kRefused, "list of 3"},
        Mistake{"no_gravity", "[0, 0, -9.81]", "[0, 0, 0]", kWarned, "gravity is zero"},
        Mistake{"a_force_in_mn", "-100]", "-100e6]", kWarned, "are forces in N"},
        Mistake{"a_traction_twice_in_gpa", "force: [0, 0, -100]", "traction: [0, 0, -1e12]", kRefused,
                "are forces in N"},
        Mistake{"an_unseen_force", "gravity: [0, 0, -9.81]\nloads: [{surface: x1, force: [0, 0, -100]}]",
                "loads: [{surface: x1, force: [0, 0, -1e-9]}]", kWarned, "too little"},
        Mistake{"no_force", "-100]", "0]", kWarned, "loads.0: force on x1 is zero"},
        Mistake{"no_traction", "force: [0, 0, -100]", "traction: [0, 0, 0]", kWarned,
                "loads.0: traction on x1 is zero"},
        Mistake{"a_force_far_too_large", "-100]", "-5 MN]", kWarned, "times its length (by linear statics)"},
        Mistake{"a_force_given_as_traction", "gravity: [0, 0, -9.81]\nloads: [{surface: x1, force: [0, 0, -100]}]",
                "loads: [{surface: x1, traction: [0, 0, -50]}]", kWarned, "force in N"},
        Mistake{"a_formula_of_nothing", "force: [0, 0, -100]", "traction: [0, 0, \"0*z\"]", kWarned, "is zero"},
        Mistake{"a_load_on_the_clamp", "surface: x1", "surface: x0", kWarned,
                "loads.0: force on x0 acts on held nodes only"},
        Mistake{"a_point_load_on_the_clamp", kLoad,
                "terms: [{type: point_load, nearest: [0, 0, 0], force: [0, 0, -1]}]", kWarned,
                "Is it the wrong point?"},
        Mistake{"a_load_after_the_end", kLoad, load_with("{type: ramp, start: 5, end: 6}"), kWarned, "begins at 5 s"},
        Mistake{"a_table_after_the_end", kLoad, load_with("{type: table, points: [[100, 0], [200, 1]]}"), kWarned,
                "the factor is 0 during the whole run"},
        Mistake{"a_formula_that_is_zero", kLoad, load_with("{type: expression, formula: \"t > 10 ? 1 : 0\"}"), kWarned,
                "the factor is 0 during the whole run"},
        Mistake{"a_sine_without_amplitude", kLoad, load_with("{type: sine, frequency: 5, amplitude: 0}"), kWarned,
                "the factor is 0 during the whole run"},
        Mistake{"a_ramp_beyond_the_end", kLoad, load_with("{type: ramp, end: 2}"), kWarned,
                "the ramp ends at 2 s, after"},
        Mistake{"a_step_beyond_the_end", kLoad, load_with("{type: smooth_step, end: 10}"), kWarned,
                "the step ends at 10 s, after"},
        Mistake{"a_sine_too_slow", kLoad, load_with("{type: sine, frequency: 1e-3}"), kWarned, "cycles during the run"},
        Mistake{"a_sine_too_fast", kLoad, load_with("{type: sine, frequency: 10 MHz}"), kWarned,
                "cycles during the run"},
        Mistake{"a_phase_in_degrees", kLoad, load_with("{type: sine, frequency: 50, phase: 90}"), kRefused,
                "'90 deg' or '90 rad'"},
        Mistake{"a_frequency_per_radian", kLoad, load_with("{type: sine, frequency: 314 rad/s}"), kRefused,
                "an angular velocity"},
        Mistake{"statics_before_the_load", kTime + "\n" + kOutput,
                "analysis: static\ntime: {end: 0}\nmotions: [{surface: x1, translation: [1, 0, 0], components: [x], "
                "factor: {type: ramp, end: 1}}]\n",
                kWarned, "where statics evaluate it"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Times, InputChecks,
    testing::Values(
        Mistake{"a_run_of_nothing", kTime, "time: {end: 5e-7}", kWarned, "a wave goes through"},
        Mistake{"a_run_in_ms", kTime, "time: {end: 5e6}", kWarned, "is the end, 5e+06 s, in ms?"},
        Mistake{"metres_for_milliseconds", kTime, "time: {end: 500 m}", kRefused, "a length (m)"},
        Mistake{"seconds_for_milliseconds", kTime, "time: {end: 500}", kWarned, "is the end, 500 s, in ms?"},
        Mistake{"frames_beyond_the_end", "probes: {tip", "interval: 5, probes: {tip", kWarned,
                "is longer than the run"},
        Mistake{"a_history_beyond_the_end", "probes: {tip", "history: {interval: 5}, probes: {tip", kWarned,
                "the history is its start and its end"},
        Mistake{"nothing_to_move_it", "gravity: [0, 0, -9.81]\n" + kLoad, "", kWarned, "it will not move"},
        Mistake{"an_anchor_in_mm", kLoad,
                "terms: [{type: spring, nearest: [1, 0, 0], anchor: [400, 0, 0], stiffness: 10}]", kWarned,
                "the anchor is 399 m away"},
        Mistake{"a_size_of_which_one_has_its_unit", "size: [1, 0.1, 0.1]", "size: [400 mm, 40, 12]", kRefused,
                "unit missing: '40' is next to '400 mm'"},
        Mistake{"a_clamp_forgotten", "clamps: [{surface: x0}]\ngravity: [0, 0, -9.81]\n" + kLoad,
                "loads: [{surface: x1, force: [0, 0, -100 kN]}]", kWarned, "is a clamp missing?"},
        Mistake{"a_ground_upside_down", "clamps: [{surface: x0}]\ngravity: [0, 0, -9.81]\n" + kLoad,
                "terms: [{type: ground_contact, point: [0, 0, -0.1], normal: [0, 0, -1], stiffness: 1e6}]", kWarned,
                "below the ground"},
        Mistake{"a_ground_within_the_body", "clamps: [{surface: x0}]\ngravity: [0, 0, -9.81]\n" + kLoad,
                "terms: [{type: ground_contact, point: [0, 0, 0.005], stiffness: 1e6}]", kWarned,
                "partly in the ground, 0.005 m deep"},
        Mistake{"an_angle_with_the_wrong_unit", "{material: wood}",
                "{material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 30 rad}}", kWarned,
                "30 rad is 4.77 turns"},
        Mistake{
            "millimetres_and_mpa",
            "size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}\nmaterials:\n  wood: {type: orthotropic_stable, density: "
            "450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu: 0.3}\nregions: {body: {material: wood}}\nclamps: "
            "[{surface: x0}]\ngravity: [0, 0, -9.81]\n" +
                kLoad,
            "size: [40, 4, 4], cells: [4, 1, 1], order: 2}\nmaterials:\n  wood: {type: orthotropic_stable, density: "
            "450, young: [10800, 840, 460], nu: 0.3}\nregions: {body: {material: wood}}\nclamps: [{surface: x0}]\n"
            "initial: {velocity: [0, 0, 0.1]}",
            kWarned, "are lengths in mm and moduli in MPa?"},
        Mistake{"damping_for_ever", "stiffness: 1e-5", "stiffness: 1e4", kWarned, "for longer than the run"},
        Mistake{"a_damping_ratio", "stiffness: 1e-5", "stiffness: 0.02", kWarned, "Is it a damping ratio?"},
        Mistake{"a_damping_ratio_of_a_region", "{material: wood}", "{material: wood, stiffness_damping: 0.05}", kWarned,
                "Is it a damping ratio?"},
        Mistake{"drag_like_honey", "stiffness: 1e-5", "mass: 1e9", kWarned, "stops every motion"},
        Mistake{"drag_of_another_unit", "stiffness: 1e-5", "mass: 1e4", kWarned, "stops every motion"},
        Mistake{"an_event_below_zero", kTime, kTime + "\nevents: [{quantity: energy.kinetic, crosses: -1}]", kWarned,
                "is never below 0"},
        Mistake{"an_event_far_away", kTime, kTime + "\nevents: [{quantity: tip.displacement.z, crosses: 500}]", kWarned,
                "500 times the length of the body"},
        Mistake{"an_event_farther_than_the_body_is_long", kTime,
                kTime + "\nevents: [{quantity: tip.displacement.z, crosses: -30}]", kWarned,
                "-30 m is 30 times the length"},
        Mistake{"an_event_at_a_stress_without_unit", kTime,
                kTime + "\nevents: [{quantity: von_mises.largest, crosses: 5}]", kWarned,
                "is the unit missing, such as MPa?"},
        Mistake{"an_event_at_a_stress_with_a_unit_too_many", kTime,
                kTime + "\nevents: [{quantity: von_mises.largest, crosses: 5e6 GPa}]", kWarned,
                "Is its unit too large?"},
        Mistake{"an_event_too_fast", kTime, kTime + "\nevents: [{quantity: tip.velocity.z, crosses: 1e6}]", kWarned,
                "faster than the waves"},
        Mistake{"an_event_of_another_dimension", kTime, kTime + "\nevents: [{quantity: tip.velocity.z, crosses: 5 mm}]",
                kRefused, "a velocity (m/s)"},
        Mistake{"an_expectation_after_the_end", kTime,
                kTime + "\nexpect: [{quantity: energy.kinetic, at: 5, value: 0, absolute: 1, source: s, reason: r}]",
                kRefused, "outside of the time span"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Motions, InputChecks,
    testing::Values(
        Mistake{"a_velocity_in_mm", kTime, kTime + "\ninitial: {velocity: [0, 0, 1e5]}", kWarned,
                "faster than a bullet"},
        Mistake{"a_spin_per_minute", kTime, kTime + "\ninitial: {spin: [0, 0, 1e5]}", kWarned, "faster than a bullet"},
        Mistake{"a_spin_in_hertz", kTime, kTime + "\ninitial: {spin: [0, 0, 5 Hz]}", kRefused, "an angular velocity"},
        Mistake{"a_velocity_for_soft_matter", kWood + "\n",
                "{type: isotropic, density: 1000, young: 1 MPa, nu: 0.3}\ninitial: {velocity: [0, 0, 500]}\n", kWarned,
                "faster than the waves in it"},
        Mistake{"a_motion_in_mm", kTime,
                kTime + "\nmotions: [{surface: x1, translation: [0, 0, 500], factor: {type: smooth_step, end: 0.5}}]",
                kWarned, "500 times the length of the body"},
        Mistake{"a_motion_in_no_time", kTime,
                kTime + "\nmotions: [{surface: x1, translation: [0, 0, 0.5], factor: {type: smooth_step, end: 1e-5}}]",
                kWarned, "faster than the waves in the body"},
        Mistake{"a_rotation_in_degrees", kTime,
                kTime + "\nmotions: [{surface: x1, rotation: {axis: [1, 0, 0], angle: 90}, factor: {type: constant}}]",
                kRefused, "'90 deg' or '90 rad'"},
        Mistake{"a_shape_in_mm", kTime, kTime + "\ninitial: {displacement_field: [\"0\", \"0\", \"50*x*x\"]}", kWarned,
                "the initial deformation"},
        Mistake{"noise_in_mm", kTime, kTime + "\ninitial: {noise: {amplitude: 5}}", kWarned,
                "more than the length of the body"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Settings, InputChecks,
    testing::Values(
        Mistake{"no_accuracy", kRtol, "rtol: 0.5", kWarned, "50 %"},
        Mistake{"an_accuracy_in_per_cent", kRtol, "rtol: 1", kRefused, "integrator.rtol"},
        Mistake{"more_digits_than_there_are", kRtol, "rtol: 1e-16", kRefused, "must be in [1e-14, 1)"},
        Mistake{"nearly_more_digits", kRtol, "rtol: 2e-14", kWarned, "1e-13"},
        Mistake{"a_scale_in_mm", kRtol, "rtol: 1e-4, position_scale: 1e6", kWarned, "Is it in mm?"},
        Mistake{"a_scale_far_beyond_the_body", kRtol, "rtol: 1e-4, position_scale: 100", kWarned,
                "100 is 100 times the scale of the body (1 m)"},
        Mistake{"a_step_longer_than_a_period", "{type: tr_bdf2, rtol: 1e-4}", "{type: newmark, step: 0.05}", kWarned,
                "cannot follow the vibration that the loads start"},
        Mistake{"a_scale_of_nothing", kRtol, "rtol: 1e-4, position_scale: 1e-15", kWarned, "position_scale"},
        Mistake{"a_speed_beyond_all", kRtol, "rtol: 1e-4, velocity_scale: 1e9", kWarned, "Is it in mm?"},
        Mistake{"a_step_longer_than_the_run", kRtol, "step: 5", kWarned, "is longer than the run"},
        Mistake{"a_step_in_nanoseconds", kRtol, "step: 1e-12", kWarned, "such steps"},
        Mistake{"a_first_step_longer_than_the_run", kRtol, "rtol: 1e-4, h0: 5", kWarned, "is longer than the run"},
        Mistake{"a_least_step_as_long_as_the_run", kRtol, "rtol: 1e-4, h_min: 0.5", kWarned, "integrator.h_min"},
        Mistake{"a_largest_step_of_nothing", kRtol, "rtol: 1e-4, h_max: 1e-12", kWarned, "such steps"}),
    [](const auto& mistake) { return mistake.param.name; });

// A strip of spruce with nine elastic constants.
const std::string kStrip = R"(mesh: {type: box, size: [1, 0.05, 0.01], cells: [4, 1, 1]}
materials:
  spruce: {type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: 0.44, nu23: 0.44, nu13: 0.45,
           g12: 0.69e9, g23: 0.032e9, g13: 0.66e9}
regions: {body: {material: spruce, axes: {first: [1, 0, 0], second: [0, 1, 0]}}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
time: {end: 0.1}
)";

class InputChecksOfAStrip : public testing::TestWithParam<Mistake> {};

TEST_P(InputChecksOfAStrip, AreNamed) {
  const Mistake& mistake = GetParam();
  const Findings findings = findings_of(replaced(kStrip, mistake.from, mistake.to));
  EXPECT_EQ(findings.refused, mistake.refused) << findings.words;
  EXPECT_THAT(findings.words, AllOf(HasSubstr(mistake.says), HasSubstr("scene.yaml:")));
}

INSTANTIATE_TEST_SUITE_P(
    Each, InputChecksOfAStrip,
    testing::Values(
        Mistake{"no_clamps", "clamps: [{surface: x0}]\n", "", kWarned, "Is a clamp missing?"},
        Mistake{"the_other_ratio_of_a_pair", "nu13: 0.45", "nu13: 0.0225", kWarned,
                "is 0.0225 the value of nu31? Then nu13 is 0.528"},
        Mistake{"grain_through_the_thickness", "first: [1, 0, 0], second: [0, 1, 0]",
                "first: [0, 0, 1], second: [1, 0, 0]", kWarned, "points along z, through the thickness"},
        Mistake{"the_other_name_of_a_shear_modulus", "g13: 0.66e9", "g31: 0.66e9", kRefused, "did you mean 'g13'?"},
        Mistake{"a_decimal_comma", "density: 400", "density: 400,5", kRefused, "is it meant as 'density: 400.5'?"},
        Mistake{"a_damping_ratio_by_name", "time: {end: 0.1}", "time: {end: 0.1}\ndamping: {ratio: 0.02}", kRefused,
                "stiffness: xi/(pi f)"},
        Mistake{"a_power_as_in_python", "force: [0, 0, -1]",
                "force: [0, 0, -1], factor: {type: expression, formula: \"sin(t)**2\"}", kRefused,
                "A power is written ^"},
        Mistake{"an_end_in_ms", "end: 0.1", "end: 200", kWarned, "in ms?"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(InputChecks, AreNoneOfAStripOrOfABlowToAFreeBody) {
  EXPECT_EQ(findings_of(kStrip).words, "");
  const std::string free = replaced(kStrip, "clamps: [{surface: x0}]\n", "");
  EXPECT_EQ(findings_of(replaced(free, "force: [0, 0, -1]",
                                 "force: [0, 0, -1], factor: {type: table, points: [[0, 0], [0.001, 1], [0.002, 0]]}"))
                .words,
            "");
  EXPECT_EQ(findings_of(replaced(free, "loads: [{surface: x1, force: [0, 0, -1]}]",
                                 "loads: [{surface: x1, force: [1, 0, 0]}, {surface: x0, force: [-1, 0, 0]}]"))
                .words,
            "");
}

TEST(InputChecks, AreNoneWhereOnlyAnotherSurfaceIsBelowTheGround) {
  const std::string ground = "terms: [{type: ground_contact, surface: z1, point: [0, 0, 0.05], stiffness: 1e6}]";
  EXPECT_EQ(findings_of(replaced(kCantilever, kLoad, ground)).words, "");
}

TEST(InputChecks, OfALoadWithoutAValueTellOnlyOfTheTimeBefore) {
  const std::string load =
      "loads: [{surface: x1, force: [0, 0, -100 kN], factor: {type: expression, formula: \"sqrt(0.25-t)\"}}]";
  const std::string free = replaced(kCantilever, "clamps: [{surface: x0}]\n", "");
  EXPECT_THAT(findings_of(replaced(free, kLoad, load)).words, HasSubstr("m away until 0.24"));
}

// The run reports such a pulse.
TEST(InputChecks, AreNoneOfAPulseThatIsTooShortToBeSampled) {
  const std::string pulse = load_with("{type: expression, formula: \"max(0, 1-abs(t-0.25)/2e-7)\"}");
  EXPECT_EQ(findings_of(replaced(kCantilever, kLoad, pulse)).words, "");
}

TEST(InputChecks, AFieldOfCellsIsNotAProbes) {
  const Findings findings = findings_of(replaced(kCantilever, "0.05]}}}", "0.05], fields: [stress]}}}"));
  EXPECT_TRUE(findings.refused);
  EXPECT_THAT(findings.words,
              HasSubstr("'stress' is a cell field, but probes are at nodes; did you mean 'nodal_stress'?"));
}

TEST(InputChecks, AreNoneInASoundScene) { EXPECT_EQ(findings_of(kCantilever).words, ""); }

TEST(InputChecks, OfModuliAreNamedWithoutLoads) {
  std::string scene = replaced(kCantilever, kYoung, "[10.8, 0.84, 0.46], nu: 0.3");
  scene = replaced(replaced(scene, "gravity: [0, 0, -9.81]\n", ""), kLoad + "\n", "");
  const Findings findings = findings_of(replaced(scene, kTime, kTime + "\ninitial: {velocity: [0, 0, 0.01]}"));
  EXPECT_FALSE(findings.refused);
  EXPECT_THAT(findings.words, HasSubstr("softer than any gel: is their unit missing, such as GPa or MPa?"));
}

// `check` and `modes` assume a second if the scene has no time span.
TEST(InputChecks, OfTimesAreNoneWithoutATimeSpan) {
  const std::string scene =
      replaced(replaced(kCantilever, kLoad, load_with("{type: ramp, start: 5, end: 6}")), kTime, "time: {end: 1}");
  EXPECT_THAT(findings_of(scene).words, HasSubstr("begins at 5 s"));
  EXPECT_TRUE(set_up(Config::from_text(scene), false, false).built.warnings.empty());
}

// Scenes with extreme values on purpose, and words of the warnings that they may cause.
const std::map<std::string, std::string> kIntended{{"block_1e6", "faster than in any solid"},
                                                   {"density_1e6", "faster than in any solid"},
                                                   {"density_1e8", "faster than in any solid"},
                                                   {"spin_of_1e4", "faster than in any solid"},
                                                   {"flying_fast", "faster than a bullet"},
                                                   {"huge", "is it meant in mm"},
                                                   {"kilometre", "is it meant in mm"},
                                                   {"nano", "scaled twice"},
                                                   {"tiny", "scaled twice"},
                                                   {"picometre", "too little"},
                                                   {"random_far", "more than the length"},
                                                   {"spun_arm", "the ramp ends at 2 s"},
                                                   {"buckling", "the ramp ends at 400 s"},
                                                   {"thousand_revolutions", "'second' is not normal to 'first'"},
                                                   {"muscle_isometric", "falls faster"}};

TEST(ShippedScenes, CauseNoFalseAlarm) {
  const fs::path configs = fs::path(ORTHODYN_SOURCE_DIR) / "configs";
  std::size_t count = 0, intended = 0;
  for (const char* folder : {"scenes", "cases", "benchmarks", "stability/cases"})
    for (const auto& entry : fs::directory_iterator(configs / folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const Config config = Config::from_file(entry.path().string()).resolving();
      const Scene scene = read_scene(config);
      const BuiltScene built = build(scene);
      Warnings warnings = check_inputs(config, scene, built);
      if (built.model->num_dofs() < 10'000) {
        const auto statics = static_response(*built.model, built.initial, scene.time.end);
        for (auto& warning : check_response(config, scene, built, statics)) warnings.push_back(warning);
      }
      ++count;
      // Stability cases have few elements and are judged by conserved quantities, so that moments of inertia do not
      // matter.
      if (std::string(folder) == "stability/cases")
        std::erase_if(warnings, [](const std::string& w) { return w.find("moment of inertia") != std::string::npos; });
      const auto found = kIntended.find(entry.path().stem().string());
      if (found == kIntended.end()) {
        EXPECT_EQ(join(warnings, "\n"), "") << entry.path();
        continue;
      }
      ++intended;
      EXPECT_FALSE(warnings.empty()) << entry.path() << ": no longer extreme?";
      for (const auto& warning : warnings) EXPECT_THAT(warning, HasSubstr(found->second)) << entry.path();
    }
  EXPECT_GT(count, 100u);
  EXPECT_EQ(intended, kIntended.size());
}

}  // namespace
}  // namespace orthodyn::input_checks_test
