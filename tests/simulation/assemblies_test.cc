// Programs' results for bodies that are joined and that touch: resumed runs, tables, and warnings before a run.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/simulation/run/setup.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/resume_fixture.h"
#include "tests/simulation/several_ranks.h"

namespace orthodyn::assemblies_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// A rigid bar swings about a hinge and hits a soft block.
const char* const kGong = R"(
mesh:
  type: bodies
  bodies:
    bar: {mesh: {type: box, size: [0.04, 0.04, 0.4], cells: [1, 1, 1], elements: hexahedra, order: 1, origin: [-0.02, -0.02, -0.4]}}
    block: {mesh: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2], elements: hexahedra, order: 1, origin: [0.05, -0.05, -0.45]}}
materials: {m: {type: isotropic, density: 500, young: 1e6, nu: 0.3}}
regions: {bar: {material: m, rigid: true}, block: {material: m}}
clamps: [{surface: block.x1}]
joints: [{type: hinge, name: pivot, from: [0, -0.02, 0], to: [0, 0.02, 0], first: {region: bar}}]
terms: [{type: barrier_contact, between: [bar, block], stiffness: 1e9}]
gravity: [0, 0, -10]
initial: {velocity_field: ["z > -0.41 && x < 0.03 ? -2*z : 0", 0, "x < 0.03 ? 2*x : 0"]}
time: {end: 0.2}
checkpoint: {every: 1000}
output: {reactions: true, mesh_error: false, probes: {end: {at: [0.02, 0.02, -0.4]}}}
integrator: {type: ida_bdf, rtol: 1e-6}
)";

TEST_F(Resume, BodiesThatAreJoinedAndTouchGoOn) {
  write("gong.yaml", kGong);
  for (const std::string method : {"ida_bdf", "cvode_bdf", "generalized_alpha"}) {
    const std::string run = "run gong.yaml --quiet --set integrator.type=" + method + " --out " + method;
    const auto first = orthodyn(run);
    ASSERT_EQ(first.exit_code, 0) << first.output;
    const auto longer = orthodyn(run + " --resume --set time.end=0.3");
    ASSERT_EQ(longer.exit_code, 0) << longer.output;
    ASSERT_EQ(record(method).at("restarts").size(), 1u) << method;
    ASSERT_EQ(orthodyn(run + "_whole --set time.end=0.3").exit_code, 0) << method;
    const auto a = read_rows(folder_ / method / "probes.csv"),
               b = read_rows(folder_ / (method + "_whole") / "probes.csv");
    ASSERT_EQ(a.back().at(0), b.back().at(0)) << method;
    EXPECT_NEAR(a.back().at(1), b.back().at(1), 1e-4) << method;  // end.displacement.x, m
    double farthest = 0;
    for (const auto& row : b) farthest = std::max(farthest, row.at(1));
    EXPECT_LT(b.back().at(1), farthest - 0.005) << method;  // thrown back
  }
}

// The rod of a slider-crank is too short for a whole turn.
TEST_F(Resume, AMechanismThatCannotMoveOnNamesItsJoints) {
  write("short.yaml", R"(
mesh:
  type: bodies
  bodies:
    crank: {mesh: {type: box, size: [0.22, 0.02, 0.02], cells: [1, 1, 1], order: 1, origin: [-0.01, -0.01, -0.01]}}
    rod: {mesh: {type: box, size: [0.17, 0.02, 0.02], cells: [1, 1, 1], order: 1, origin: [0.19, 0.02, -0.01]}}
    block: {mesh: {type: box, size: [0.1, 0.06, 0.06], cells: [1, 1, 1], order: 1, origin: [0.3, -0.01, -0.03]}}
materials: {steel: {type: isotropic, density: 7800, young: 2e11, nu: 0.3}}
regions: {all: {material: steel, rigid: true}}
joints:
  - type: hinge
    name: bearing
    from: [0, 0, 0]
    to: [0, 0.02, 0]
    first: {region: crank}
    motor: {to: 90 deg, factor: {type: smooth_step, end: 1}}
  - {type: ball, name: pin, at: [0.2, 0.02, 0], first: {region: rod}, second: {region: crank}}
  - {type: ball, name: wrist, at: [0.35, 0.02, 0], first: {region: block}, second: {region: rod}}
  - {type: slider, name: rail, from: [0.35, 0.02, 0], to: [0.45, 0.02, 0], first: {region: block}}
time: {end: 1}
)");
  for (const char* method : {"ida_bdf", "cvode_bdf", "generalized_alpha"}) {
    const auto result = orthodyn(std::string("run short.yaml --quiet --force --set integrator.type=") + method);
    EXPECT_EQ(result.exit_code, 3) << method << result.output;
    EXPECT_THAT(result.output, HasSubstr("at t = 0.52")) << method;
    EXPECT_THAT(result.output, HasSubstr("the mechanism cannot move on")) << method;
    EXPECT_THAT(result.output, HasSubstr("pin")) << method;
  }
}

// A rigid bar turns by 10 rad/s about a hinge: five turns in 3.14 s, in two runs.
const char* const kRotor = R"(
mesh:
  type: bodies
  bodies:
    bar: {mesh: {type: box, size: [0.04, 0.04, 0.4], cells: [1, 1, 1], elements: hexahedra, order: 1, origin: [-0.02, -0.02, -0.4]}}
materials: {m: {type: isotropic, density: 500, young: 1e6, nu: 0.3}}
regions: {bar: {material: m, rigid: true}}
joints: [{type: hinge, name: pivot, from: [0, -0.02, 0], to: [0, 0.02, 0], first: {region: bar}}]
initial: {velocity_field: ["10*z", 0, "-10*x"]}
time: {end: 1.5}
checkpoint: {every: 1000}
events: [{quantity: coordinate.pivot, crosses: 20, name: turned}]
output: {reactions: true, mesh_error: false}
integrator: {type: ida_bdf, rtol: 1e-6}
)";

TEST_F(Resume, AnglesOfHingesCountTurns) {
  write("rotor.yaml", kRotor);
  for (const std::string method : {"ida_bdf", "cvode_bdf", "generalized_alpha"}) {
    const std::string run = "run rotor.yaml --quiet --set integrator.type=" + method + " --out " + method;
    const auto first = orthodyn(run);
    ASSERT_EQ(first.exit_code, 0) << first.output;
    ASSERT_EQ(orthodyn(run + " --resume --set time.end=3.14").exit_code, 0) << method;
    const auto rows = read_rows(folder_ / method / "probes.csv");
    for (const auto& row : rows) EXPECT_NEAR(row.back(), 10 * row.at(0), 2e-3 * (1 + 10 * row.at(0))) << method;
    EXPECT_NEAR(rows.back().back(), 31.4, 0.05) << method;
    const std::string events = read_text(folder_ / method / "events.csv");
    EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 2) << method << events;
    EXPECT_NEAR(std::stod(events.substr(events.find('\n'))), 2, 5e-3) << method << events;
  }
}

// The motor begins at two turns, and so does the angle of its joint.
TEST_F(Resume, AMotorMayBeginAfterWholeTurns) {
  std::string driven = kRotor;
  driven.replace(driven.find("first: {region: bar}"), 20,
                 "first: {region: bar}, motor: {to: 720 deg, factor: {type: expression, formula: 'cos(t)'}}");
  driven.erase(driven.find("initial:"), driven.find("time:") - driven.find("initial:"));
  write("driven.yaml", driven);
  const auto result = orthodyn("run driven.yaml --quiet --out driven");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const std::string header = read_text(folder_ / "driven/probes.csv");
  const std::string names = header.substr(0, header.find('\n'));
  const auto column = static_cast<std::size_t>(
      std::count(names.begin(), names.begin() + static_cast<long>(names.find("coordinate.pivot")), ','));
  for (const auto& row : read_rows(folder_ / "driven/probes.csv"))
    EXPECT_NEAR(row.at(column), 4 * 3.14159265358979 * std::cos(row.at(0)), 1e-6);
}

TEST_F(Resume, AnInertiaInAnotherUnitIsTold) {
  const auto check = [&](const std::string& inertia) {
    std::string given = kRotor;
    given.replace(given.find("rigid: true"), 11, "rigid: {mass: 1, center: [0, 0, -0.2], inertia: " + inertia + "}");
    write("given.yaml", given);
    return orthodyn("check given.yaml").output;
  };
  EXPECT_THAT(check("[140, 140, 2.7]"), HasSubstr("are `inertia` in kg m^2 and `mass` in kg?"));  // kg cm^2
  EXPECT_THAT(check("[1.4e-2, 1.4e-2, 2.7e-4]"), Not(HasSubstr("kg m^2 and")));
}

// Springs of hinges see angles from -180 to 180 degrees, and a run in which that matters says so.
TEST_F(Resume, ASpringThatIsWoundUpIsTold) {
  std::string wound = kRotor;
  wound.replace(wound.find("first: {region: bar}"), 20, "first: {region: bar}, spring: {stiffness: 1e-6}");
  write("wound.yaml", wound);
  const auto result = orthodyn("run wound.yaml --out wound");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("pivot turned by more than 180 degrees"));
  EXPECT_THAT(orthodyn("run wound.yaml --out short --set time.end=0.2").output, Not(HasSubstr("180 degrees")));
}

// The far face of the block is no obstacle: the bar goes through it.
TEST_F(Resume, AContactThatNeverActsIsTold) {
  write("gong.yaml", kGong);
  const std::string run = "run gong.yaml --out a --force --set time.end=0.1 --set ";
  const std::string term = "{type: contact, between: [bar.x0, block.x1], stiffness: 1e9}";
  const auto none = orthodyn(run + "'terms=[" + term + "]'");
  ASSERT_EQ(none.exit_code, 0) << none.output;
  EXPECT_THAT(none.output, HasSubstr("nothing touched: contact_1 had no force"));
  EXPECT_THAT(none.output, HasSubstr("'bar.x0' and 'block.x1' look away from each other"));
  const auto one =
      orthodyn(run + "'terms=[" + term + ", {type: barrier_contact, between: [bar, block], stiffness: 1e9}]'");
  ASSERT_EQ(one.exit_code, 0) << one.output;
  EXPECT_THAT(one.output, Not(HasSubstr("nothing touched")));
  const auto alike = orthodyn(run + "'terms=[{type: contact, between: [bar.x1, block.x1], stiffness: 1e9}]'");
  EXPECT_THAT(alike.output, HasSubstr("'bar.x1' and 'block.x1' look in the same direction"));
  const auto facing = orthodyn(run + "'terms=[{type: contact, between: [bar.x1, block.x0], stiffness: 1e9}]'");
  EXPECT_THAT(facing.output, Not(HasSubstr("look ")));
  EXPECT_THAT(one.output, HasSubstr("never touched: contact_1\n"));
}

// Contact holds no body in statics; the message names the body that is free.
TEST_F(Resume, ABodyThatContactAloneWouldHoldIsNamed) {
  write("stack.yaml", R"(
mesh:
  type: bodies
  bodies:
    lower: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}}
    upper: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}, translation: [0, 0, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
regions: {lower: {material: m}, upper: {material: m}}
terms: [{type: contact, between: [lower.z1, upper.z0], stiffness: 1e8}]
gravity: [0, 0, -10]
clamps: [{surface: lower.z0}]
analysis: static
)");
  const auto result = orthodyn("run stack.yaml --quiet");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr("[0.5, 0.5, 1.5] m (region upper)"));
  EXPECT_THAT(result.output, HasSubstr("contact does not hold it"));
}

TEST_F(Resume, TablesHaveTheColumnsOfJointsAndContacts) {
  write("gong.yaml", kGong);
  ASSERT_EQ(orthodyn("run gong.yaml --quiet --out gong").exit_code, 0);
  const std::string header = read_text(folder_ / "gong/probes.csv");
  for (const char* column : {"joint.pivot.x", "joint.pivot.z", "coordinate.pivot", "contact.contact_1.x"})
    EXPECT_THAT(header.substr(0, header.find('\n')), HasSubstr(column));
}

// Both blocks have a node at the place of the probes; the upper one falls. A hinge that holds the nodes of a plane has
// an angle without a spring.
TEST_F(Resume, ProbesAreOfTheirRegion) {
  write("two.yaml", R"(
mesh:
  type: bodies
  bodies:
    lower: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}}
    upper: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}, translation: [0, 0, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
regions: {lower: {material: m}, upper: {material: m}}
joints: [{type: hinge, name: pin, from: [0, 0, 2], to: [0, 1, 2], first: {surface: upper.z1}}]
gravity: [0, 0, -10]
clamps: [{surface: lower.z0}]
time: {end: 0.1}
integrator: {type: ida_bdf, rtol: 1e-4}
output:
  reactions: true
  mesh_error: false
  probes:
    below: {at: [1, 1, 1], region: lower}
    above: {at: [1, 1, 1], region: upper}
)");
  const auto result = orthodyn("run two.yaml --quiet --out two");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto header = read_text(folder_ / "two/probes.csv");
  EXPECT_THAT(header, HasSubstr("coordinate.pin"));
  const auto last = read_rows(folder_ / "two/probes.csv").back();  // t, below.x to z, above.x to z, ...
  EXPECT_LT(last.at(6), -0.01);
  EXPECT_GT(last.at(3), -0.01);
  EXPECT_EQ(orthodyn("run two.yaml --quiet --out other --set output.probes.below.region=none").exit_code, 2);
}

// The warnings before a run of two blocks, the upper one at the height z.
std::string warnings_of(const std::string& elements, const std::string& type, double z) {
  std::string words;
  for (const auto& warning : set_up(Config::from_text(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1, 1], cells: [2, 2, 1], {0}}}}}
    upper: {{mesh: {{type: box, size: [0.6, 0.6, 0.6], cells: [1, 1, 1], {0}}}, translation: [0.17, 0.13, {1}]}}
materials: {{m: {{type: orthotropic_stable, density: 500, young: [1e7, 1e6, 2e6], nu: 0.3}}}}
clamps: [{{surface: lower.z0}}]
gravity: [0, 0, -10]
terms: [{{type: {2}, between: [lower, upper], stiffness: 1e9}}]
time: {{end: 0.1}}
integrator: {{type: ida_bdf}}
)",
                                                                  elements, z, type),
                                                      "scene.yaml"))
                                 .built.warnings)
    words += warning + "\n";
  return words;
}

TEST(ContactChecks, TellOfOverlaps) {
  const std::string plain = "elements: hexahedra, order: 1";
  EXPECT_THAT(warnings_of(plain, "contact", 1.01), Not(HasSubstr("overlap")));
  EXPECT_THAT(warnings_of(plain, "contact", 0.99), HasSubstr("contact of lower and upper: the bodies overlap"));
  EXPECT_THAT(warnings_of(plain, "barrier_contact", 1.05), Not(HasSubstr("far nearer")));
  EXPECT_THAT(warnings_of(plain, "barrier_contact, gap: 0.1", 1.005), HasSubstr("far nearer than the gap"));
}

// Two blocks, the lower one clamped, with this connection.
std::string blocks(const std::string& connection, const std::string& more) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}}}}
    upper: {{mesh: {{type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}}, translation: [0, 0, 1]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}
clamps: [{{surface: lower.z0}}]
gravity: [0, 0, -10]
{}
{}
)",
                     connection, more);
}
const std::string kBall =
    "joints: [{type: ball, name: pin, at: [0.5, 0.5, 1], first: {surface: upper.z0}, second: {surface: lower.z1}}]";
const std::string kStrut =
    "joints: [{type: strut, name: leg, from: [1, 1, 2], to: [0, 0, 0], spring: {stiffness: 1e5}, first: {nearest: [1, "
    "1, 2]}}]";
const std::string kRigid = "regions: {lower: {material: m}, upper: {material: m, rigid: true}}";
const std::string kTouch = "terms: [{type: contact, between: [lower.z1, upper.z0], stiffness: 1e7}]";
const std::string kTie = "ties: [{first: upper.z0, second: lower.z1}]";
const std::string kMoving = "time: {end: 0.01}\n";
const std::string kByBdf = kMoving + "integrator: {type: cvode_bdf, rtol: 1e-3}\n";
const std::string kDerivative =
    kByBdf + "sensitivities: [materials.m.young]\noutput: {probes: {top: {at: [1, 1, 2]}}}\n";
const std::string kProbe = kByBdf + "output: {probes: {top: {at: [1, 1, 2]}}}\n";
const char* const kRun = "run scene.yaml --out out";
const char* const kGradient = "gradient scene.yaml --of top.displacement.z --by materials.m.young --out out";

// What an analysis cannot do is told, with what to do.
struct Refusal {
  const char* name;
  std::string connection, more, command, says, advice;
};
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

class Refused : public InFolder, public testing::WithParamInterface<Refusal> {};

INSTANTIATE_TEST_SUITE_P(
    Assemblies, Refused,
    testing::Values(
        Refusal{"StaticsOfJoints", kBall, "analysis: static", kRun, "joints: applies only with analysis: dynamic",
                "remove it"},
        Refusal{"BucklingOfJoints", kBall, "analysis: buckling", kRun, "joints: applies only with analysis: dynamic",
                "remove it"},
        Refusal{"ResponsesOfJoints", kBall, "analysis: harmonic\nharmonic: {from: 1, to: 2, damping_ratio: 0.01}", kRun,
                "joints: applies only with analysis: dynamic", "remove it"},
        Refusal{"StaticsOfStruts", kStrut, "analysis: static", kRun, "joints: applies only with analysis: dynamic",
                "remove it"},
        Refusal{"StaticsOfFreeRigidBodies", kRigid, "analysis: static", kRun,
                "free rigid bodies need analysis: dynamic", "clamp it"},
        Refusal{"BucklingOfFreeRigidBodies", kRigid, "analysis: buckling", kRun,
                "free rigid bodies need analysis: dynamic", "clamp it"},
        Refusal{"EquilibriaOfJoints", kBall, kMoving + "start: equilibrium", kRun,
                "joints are not available with start: equilibrium", "start at rest"},
        Refusal{"EquilibriaOfFreeRigidBodies", kRigid, kMoving + "start: equilibrium", kRun,
                "free rigid bodies need analysis: dynamic and start: rest", "clamp it"},
        Refusal{"ModesOfJoints", kBall, kMoving, "modes scene.yaml --out out",
                "natural modes are not available with joints", "replace joints by springs"},
        Refusal{"ModesOfFreeRigidBodies", kRigid, kMoving, "modes scene.yaml --out out",
                "not available with joints and free rigid regions", "remove `rigid`"},
        Refusal{"SensitivitiesOfJoints", kBall, kDerivative, kRun,
                "sensitivities: are not computed for motions with joints", "compute differences between runs"},
        Refusal{"SensitivitiesOfFreeRigidBodies", kRigid, kDerivative, kRun, "joints or free rigid bodies",
                "compute differences between runs"},
        Refusal{"SensitivitiesOfContact", kTouch, kDerivative, kRun, "are not computed with contact",
                "has no derivative"},
        Refusal{"GradientsOfJoints", kBall, kProbe, kGradient, "adjoint equations are not available with joints",
                "compute differences between runs"},
        Refusal{"GradientsOfFreeRigidBodies", kRigid, kProbe, kGradient, "joints or free rigid bodies",
                "compute differences between runs"},
        Refusal{"GradientsOfContact", kTouch, kProbe, kGradient, "the scene has contact",
                "compute differences between runs"},
        Refusal{"EnergyMomentumOfJoints", kBall, kMoving + "integrator: {type: energy_momentum, step: 1e-3}", kRun,
                "not available with joints", "use ida_bdf"},
        Refusal{"EnergyMomentumOfStruts", kStrut, kMoving + "integrator: {type: energy_momentum, step: 1e-3}", kRun,
                "forces of joints have no mean force", "choose another integrator"},
        Refusal{"EnergyMomentumOfContact", kTouch, kMoving + "integrator: {type: energy_momentum, step: 1e-3}", kRun,
                "Contact of bodies", "choose another integrator"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(Refused, ByNameWithWhatToDo) {
  write("scene.yaml", blocks(GetParam().connection, GetParam().more));
  const auto result = orthodyn(GetParam().command);
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr(GetParam().says));
  EXPECT_THAT(result.output, HasSubstr(GetParam().advice));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "run.json"));
}

class AssembliesOnSeveralRanks : public SeveralRanks, public testing::WithParamInterface<Refusal> {};

INSTANTIATE_TEST_SUITE_P(
    Refused, AssembliesOnSeveralRanks,
    testing::Values(Refusal{"Joints", kBall, "", "", "joints are not available on several ranks", "run on one"},
                    Refusal{"Struts", kStrut, "", "", "joints are not available on several ranks", "run on one"},
                    Refusal{"RigidBodies", kRigid, "", "", "rigid regions are not available on several ranks",
                            "run on one"},
                    Refusal{"Ties", kTie, "", "", "ties are not available on several ranks", "run on one"},
                    Refusal{"Contact", kTouch, "", "", "does not run on several ranks", "run on one"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(AssembliesOnSeveralRanks, AreRefusedByName) {
  write("scene.yaml",
        blocks(GetParam().connection,
               kMoving + "integrator: {type: generalized_alpha, step: 1e-3}\noutput: {mesh_error: false}"));
  const auto result = orthodyn_on(2, "run scene.yaml --out out");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr(GetParam().says));
  EXPECT_THAT(result.output, HasSubstr(GetParam().advice));
}

// Fits then take differences between runs.
TEST(MotionSensitivities, AreNotPromisedForConstraints) {
  const auto has = [](const std::string& connection) {
    const Config config = Config::from_text(blocks(connection, kByBdf), "scene.yaml").resolving();
    return has_motion_sensitivity(config, read_scene(config), {"materials.m.young"});
  };
  EXPECT_TRUE(has(kTie));
  EXPECT_TRUE(has(kStrut));
  EXPECT_FALSE(has(kBall));
  EXPECT_FALSE(has(kRigid));
  EXPECT_FALSE(has(kTouch));
}

// A strut with a spring has the natural frequencies, and the derivatives of motions, of the term `spring` between the
// same points.
TEST_F(Resume, AStrutVibratesAsASpring) {
  const std::string spring = "terms: [{type: spring, nearest: [1, 1, 2], anchor: [0, 0, 0], stiffness: 1e5}]";
  for (const auto& [name, connection] : {std::pair("strut", kStrut), std::pair("spring", spring)}) {
    write("modes.yaml", blocks(connection + "\n" + kTie, kByBdf));
    write("run.yaml", blocks(connection + "\n" + kTie, kDerivative));
    const auto modes = orthodyn(std::string("modes modes.yaml -n 5 --quiet --out modes_") + name);
    ASSERT_EQ(modes.exit_code, 0) << modes.output;
    const auto run = orthodyn(std::string("run run.yaml --quiet --out run_") + name);
    ASSERT_EQ(run.exit_code, 0) << run.output;
  }
  const auto strut = read_rows(folder_ / "modes_strut/modes.csv"),
             springs = read_rows(folder_ / "modes_spring/modes.csv");
  ASSERT_EQ(strut.size(), springs.size());
  for (std::size_t row = 0; row < strut.size(); ++row)  // Hz
    EXPECT_NEAR(strut[row].at(1), springs[row].at(1), 1e-6 * springs[row].at(1));
  const auto slopes = read_rows(folder_ / "run_strut/sensitivities.csv").back(),
             expected = read_rows(folder_ / "run_spring/sensitivities.csv").back();
  ASSERT_EQ(slopes.size(), expected.size());
  double largest = 0;
  for (std::size_t c = 1; c < 4; ++c) largest = std::max(largest, std::abs(expected[c]));  // top.displacement, m/Pa
  EXPECT_GT(largest, 0);
  for (std::size_t c = 1; c < 4; ++c) EXPECT_NEAR(slopes[c], expected[c], 0.02 * largest);
}

}  // namespace
}  // namespace orthodyn::assemblies_test
