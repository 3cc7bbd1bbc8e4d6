// The points of a sweep: values, formulas, and errors with their places.
#include "lib/study/sweep/sweep_design.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/simulation/run_program.h"

namespace orthodyn::study::sweep::sweep_design_test {
namespace {

using testing::HasSubstr;

class SweepDesign : public InFolder {
 protected:
  SweepDesign() { write("swing.yaml", kSwing); }

  std::vector<Point> points(const std::string& rest) const {
    return expand(read_sweep(Config::from_file(write("s.yaml", "scene: swing.yaml\n" + rest).string())));
  }
  std::string complaint(const std::string& rest) const {
    try {
      points(rest);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }
  static double value(const Point& point, const std::string& path) {
    Config at = Config::from_text(point.scene.scene);
    std::istringstream steps(path);
    for (std::string step; std::getline(steps, step, '.');)
      at = std::isdigit(static_cast<unsigned char>(step[0])) ? at.at(std::stoul(step)) : at.at(step);
    return at.number();
  }
};

constexpr const char* kMetric = "quantities: {f: {mode: 1}}\n";

TEST_F(SweepDesign, DividesRangesEvenlyByDifferenceOrByRatio) {
  const auto linear = points(kMetric + std::string("vary: {materials.soft.nu: {from: 0, to: 0.4, count: 5}}"));
  ASSERT_EQ(linear.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_DOUBLE_EQ(value(linear[i], "materials.soft.nu"), 0.1 * static_cast<double>(i));
  const auto log =
      points(kMetric + std::string("vary: {materials.soft.young: {from: 1e3, to: 1e6, count: 4, scale: log}}"));
  ASSERT_EQ(log.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(value(log[i], "materials.soft.young"), std::pow(10, 3 + i), 1e-9 * std::pow(10, 3 + i));
}

TEST_F(SweepDesign, TellsNumbersApartHoweverClose) {
  const auto all = points(kMetric + std::string("vary: {materials.soft.density: {from: 999, to: 1001, count: 501}}"));
  ASSERT_EQ(all.size(), 501u);
  EXPECT_EQ(all[249].title, "density 999.996");
  EXPECT_EQ(all[251].title, "density 1000.004");
  EXPECT_THAT(complaint(kMetric + std::string("vary: {materials.soft.density: [1000, 1e3]}")),
              HasSubstr("the value 1000 twice"));
}

TEST_F(SweepDesign, CombinesEveryValueWithEveryOther) {
  const auto all =
      points(kMetric + std::string("vary: {materials.soft.nu: [0, 0.1, 0.2], materials.soft.density: [1, 2]}"));
  std::set<std::pair<double, double>> seen;
  for (const auto& p : all) seen.emplace(value(p, "materials.soft.nu"), value(p, "materials.soft.density"));
  EXPECT_EQ(all.size(), 6u);
  EXPECT_EQ(seen.size(), 6u);
}

TEST_F(SweepDesign, CountsCombinationsBeforeItMakesThem) {
  EXPECT_THAT(complaint(kMetric + std::string("vary: {materials.soft.nu: {from: 0, to: 0.4, count: 10000}, "
                                              "materials.soft.density: {from: 1, to: 2, count: 10000}}")),
              AllOf(HasSubstr("s.yaml:3:"), HasSubstr("1e+08 points, more than the limit of 1e+07")));
}

TEST_F(SweepDesign, ZipsValuesSideBySide) {
  const std::string head = kMetric + std::string("combine: zip\n");
  const auto all = points(head + "vary: {materials.soft.nu: [0, 0.1], materials.soft.density: [1, 2]}");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(value(all[1], "materials.soft.nu"), 0.1);
  EXPECT_EQ(value(all[1], "materials.soft.density"), 2);
  EXPECT_THAT(complaint(head + "vary: {materials.soft.nu: [0, 0.1], materials.soft.density: [1]}"),
              HasSubstr("'density' has 1, 'nu' has 2"));
}

TEST_F(SweepDesign, SpreadsALatinHypercubeOverRangesAndLists) {
  const std::string text = kMetric + std::string(R"(combine: latin_hypercube
samples: 8
seed: 3
vary:
  materials.soft.nu: {from: 0, to: 0.4}
  materials.soft.young: {from: 1e4, to: 1e6, scale: log}
  materials.soft.density: [1000, 2000]
)");
  const auto all = points(text);
  ASSERT_EQ(all.size(), 8u);
  std::multiset<double> densities;
  std::set<int> strata;
  for (const auto& p : all) {
    densities.insert(value(p, "materials.soft.density"));
    strata.insert(static_cast<int>(std::log10(value(p, "materials.soft.young") / 1e4) / 2 * 8));
  }
  EXPECT_EQ(densities.count(1000), 4u);
  EXPECT_EQ(strata.size(), 8u);
  const auto again = points(text);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(all[i].scene.scene, again[i].scene.scene);
}

TEST_F(SweepDesign, TakesNamedSetsUnitsAndFormulasOfThemAll) {
  const auto all = points(R"(
vary:
  stiffer: {from: 1, to: 100, count: 3, scale: log}
  body:
    heavy: {materials.soft.density: "=rho*10", rho: 300}
    light: {materials.soft.density: "=rho", rho: 200}
  initial.velocity: {values: [[0, 0, 0]], name: push}
  materials.soft.young: {values: [2], unit: kPa, name: E}
definitions: {twice: 2*E*stiffer}
quantities: {f: {mode: 1, closed_form: twice + rho}}
)");
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(value(all[0], "materials.soft.density"), 3000);
  EXPECT_NEAR(all[5].closed_forms[0], 2 * 2000.0 * 100 + 200, 1e-6);
  EXPECT_EQ(all[5].title, "stiffer 100, body light, push [0, 0, 0], E 2 kPa");
}

TEST_F(SweepDesign, GivesFormulasOnlyNamesThatTheyCanHave) {
  const std::string rest = "quantities: {f: {mode: 1, closed_form: 2*E}}\ndefinitions: {E: 5}\n";
  EXPECT_EQ(points("vary: {gravity.2: [-1, -2]}\n" + rest).at(1).closed_forms[0], 10);
  const auto refused = [&](const std::string& vary, const std::string& why) {
    EXPECT_THAT(complaint("vary: {" + vary + "}\n" + rest), AllOf(HasSubstr("s.yaml:2:"), HasSubstr(why))) << vary;
  };
  refused("gravity.2: {values: [1], name: 2g}", "the name '2g'");
  refused("gravity.2: {from: 1, to: 2, count: 2, name: my g}", "the name 'my g'");
  refused("gravity.2: {values: [1], name: e}", "'e' is a constant");
  refused("pi: [3, 4]", "'pi' is a constant");
  refused("kind: {a: {e: 1}, b: {e: 2}}", "'e' is a constant");
  const std::string vary = "vary: {materials.soft.nu: [0, 0.1]}\n";
  EXPECT_THAT(complaint(vary + kMetric + "definitions:\n  a: 1\n  pi: 3\n"),
              AllOf(HasSubstr("s.yaml:6:"), HasSubstr("'pi' is a constant")));
  EXPECT_THAT(complaint(vary + kMetric + "definitions:\n  a: 1\n  b: 2*c\n"),
              AllOf(HasSubstr("s.yaml:6:"), HasSubstr("cannot read the formula '2*c'")));
}

TEST_F(SweepDesign, RefusesTwoVariablesThatSetTheSamePath) {
  const std::string head = std::string(kMetric) + "vary:\n";
  EXPECT_THAT(complaint(head + "  materials.soft.nu: [0.1, 0.2]\n  kind: {a: {materials.soft.nu: 0.3}}\n"),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("s.yaml:4:"), HasSubstr("remove one of the two")));
  EXPECT_THAT(complaint(head + "  a: {x: {gravity: [0, 0, -1]}}\n  b: {y: {gravity: [0, 0, -2]}}\n"),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("s.yaml:4:")));
  // Setting a section after one of its keys removes the key; the other order keeps it.
  EXPECT_THAT(complaint(head + "  gravity.2: [-1, -2]\n  kind: {a: {gravity: [0, 0, 0]}}\n"),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("replaces 'gravity.2'"), HasSubstr("s.yaml:4:")));
  const auto all = points(head + "  kind: {a: {gravity: [1, 0, 0]}}\n  gravity.2: [-1, -2]\n");
  EXPECT_EQ(value(all[1], "gravity.0"), 1);
  EXPECT_EQ(value(all[1], "gravity.2"), -2);
}

TEST_F(SweepDesign, RefusesASlipInANamedSet) {
  EXPECT_THAT(complaint(kMetric + std::string("vary:\n  kind:\n    a: {gravty: [0, 0, -2]}\n    b: {}\n")),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("did you mean 'gravity'?")));
  EXPECT_THAT(complaint(kMetric + std::string("vary:\n  kind:\n    a: {rho: 1}\n    b: {}\n")),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("no formula uses it")));
  EXPECT_THAT(complaint(kMetric + std::string("vary:\n  kind:\n    \"\": {}\n")),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("has a blank name")));
}

TEST_F(SweepDesign, RefusesANameForTwoThings) {
  const std::string rest = "quantities: {f: {mode: 1, closed_form: nu + x}}\n";
  EXPECT_THAT(complaint(rest + "vary:\n  materials.soft.nu: [0.1]\ndefinitions:\n  x: 2\n  nu: 1\n"),
              AllOf(HasSubstr("s.yaml:7:"), HasSubstr("the name 'nu' is already used at"), HasSubstr("s.yaml:4:")));
  EXPECT_THAT(complaint(rest + "vary:\n  materials.soft.nu: [0.1]\n  k: {a: {x: 1}, b: {x: 2}}\n  m: {c: {x: 3}}\n"),
              AllOf(HasSubstr("s.yaml:6:"), HasSubstr("the name 'x' is already used at"), HasSubstr("s.yaml:5:")));
  EXPECT_EQ(complaint(rest + "vary:\n  materials.soft.nu: [0.1]\n  x: {a: {x: 1}, b: {x: 2}}\n"), "");
}

TEST_F(SweepDesign, NamesAnEntryOfAListByItsListToo) {
  const auto all = points(kMetric + std::string("vary: {gravity.2: [-1, -2], output.probes.tip.at.0: [1]}"));
  EXPECT_EQ(all[0].title, "gravity.2 -1, at.0 1");
}

// A sweep of a scene with an inclined grain.
std::string with_grain(const std::string& vary, const std::string& angle = "0") {
  return std::string(kMetric) + "scene: {file: swing.yaml, set: {regions: {body: {material: soft, axes: {type: " +
         "axis_angle, axis: [0, 0, 1], angle: " + angle + "}}}}}\nvary: {" + vary + "}\n";
}

class SweepOfAngles : public SweepDesign {
 protected:
  std::vector<Point> expanded(const std::string& text) const {
    return expand(read_sweep(Config::from_file(write("a.yaml", text).string())));
  }
  std::string complaint_about(const std::string& text) const {
    try {
      expanded(text);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(SweepOfAngles, AsksForTheirUnit) {
  constexpr const char* kAngle = "regions.body.axes.angle";
  const auto angle = [&](const std::string& values) { return with_grain(kAngle + (": " + values)); };
  EXPECT_THAT(complaint_about(angle("{from: 0, to: 90, count: 3}")),
              AllOf(HasSubstr("a.yaml:3:"), HasSubstr("an angle needs a unit: add unit: deg")));
  EXPECT_THAT(complaint_about(angle("[0, 30]")), HasSubstr("an angle needs a unit"));
  EXPECT_EQ(complaint_about(angle("{from: 0, to: 90, count: 3, unit: deg}")), "");
  EXPECT_EQ(complaint_about(angle("[0 deg, 0.3 rad]")), "");
  const std::string whole = "grain: {a: {regions: {body: {material: soft, axes: {type: euler, convention: zyx, ";
  EXPECT_THAT(complaint_about(with_grain(whole + "angles: [30, 0, 0]}}}}}")), HasSubstr("'30 deg' or '30 rad'"));
}

TEST_F(SweepOfAngles, TakesTheValuesOfFormulasForRadians) {
  const auto angle_of = [&](const std::string& text) {
    const auto all = expanded(text);
    return Config::from_text(all.back().scene.scene).at("regions").at("body").at("axes").at("angle").text();
  };
  EXPECT_EQ(angle_of(with_grain("tilt: {values: [90], unit: deg}", "=tilt/2")),
            number_text(std::numbers::pi / 4) + " rad");
  EXPECT_EQ(angle_of(with_grain("turns: [3]", "=2*pi*turns")), number_text(6 * std::numbers::pi) + " rad");
  EXPECT_THAT(complaint_about(with_grain("tilt: [90]", "=tilt/2")),
              AllOf(HasSubstr("'tilt/2' gives 45 rad"), HasSubstr("give its variables the unit deg")));
}

TEST_F(SweepDesign, ReadsQuantitiesWithUnits) {
  const std::string rest = "quantities: {f: {mode: 1, closed_form: E*twice}}\ndefinitions: {twice: 2 kPa}\n";
  const auto list = points(rest + "vary: {materials.soft.young: {values: [20 kPa, 0.1 MPa], name: E}}");
  EXPECT_EQ(list[1].title, "E 100 kPa");
  EXPECT_NEAR(list[1].closed_forms[0], 2e8, 1e-3);
  EXPECT_THAT(list[1].scene.scene, HasSubstr("young: 0.1 MPa"));
  const auto range = points(rest + "vary: {materials.soft.young: {from: 20 kPa, to: 1 MPa, count: 2, name: E}}");
  EXPECT_EQ(range[1].title, "E 1000 kPa");
  EXPECT_NEAR(range[1].closed_forms[0], 2e9, 1e-3);
  const auto free = points(rest + "vary: {E: [20 kPa, 0.1 MPa]}");
  EXPECT_NEAR(free[1].closed_forms[0], 2e8, 1e-3);
  const auto refused = [&](const std::string& vary, const std::string& why) {
    EXPECT_THAT(complaint(rest + "vary: {E: " + vary + "}"), AllOf(HasSubstr("s.yaml:4:"), HasSubstr(why))) << vary;
  };
  refused("[20 kPa, 1e5]", "has no unit, but another value has");
  refused("{from: 20 kPa, to: 1e5, count: 2}", "one of 'from' and 'to' has a unit");
  refused("{from: 20 kPa, to: 3 m, count: 2}", "expected a quantity that has the unit kPa, found '3 m'");
  refused("{from: 1 kPas, to: 3 kPas, count: 2}", "the unit 'kPas' is not known");
  refused("{from: 1 MPa, to: 1000 kPa, count: 2}", "is equal to 'from'");
  refused("{from: low, to: 3, count: 2}", "expected a number, found 'low'");
  refused("[1 MPa, 1000 kPa]", "the value 1 twice");
}

TEST_F(SweepDesign, RefusesTimesBeyondTheSpanOfAnyPoint) {
  const std::string vary = "vary: {time.end: [0.5, 0.1]}\n";
  EXPECT_THAT(complaint(vary + "quantities:\n  f: {quantity: tip.displacement.z, at: 0.2}\n"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("f.at: 0.2 s is outside")));
  EXPECT_EQ(complaint(vary + "quantities:\n  f: {quantity: tip.displacement.z, at: 0.1}\n"), "");
  EXPECT_THAT(complaint(vary + kMetric + "frames: {at: 0.2}\n"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("frames.at: 0.2 s is outside")));
}

TEST_F(SweepDesign, RefusesColoursThatCannotBeDrawn) {
  const std::string head = std::string(kMetric) + "vary: {materials.soft.nu: [0.1]}\nframes: {color: ";
  EXPECT_THAT(complaint(head + "stres}"), AllOf(HasSubstr("s.yaml:4:"), HasSubstr("did you mean 'stress'?")));
  EXPECT_THAT(complaint(head + "stress.11}"), HasSubstr("'stress' has no component '11'; known: xx"));
  EXPECT_THAT(complaint(head + "det_f.x}"), HasSubstr("it is a number"));
  EXPECT_THAT(complaint(head + "energy.elastic}"), HasSubstr("there is no field 'energy'"));
  for (const char* color :
       {"displacement", "velocity.z", "stress.von_mises", "stress_material.12", "det_f", "strain.11"})
    EXPECT_EQ(complaint(head + color + "}"), "");
}

TEST_F(SweepDesign, RefusesColumnsThatTheTableHasAlready) {
  const std::string head = "vary: {materials.soft.nu: [0.1]}\nquantities:\n  ";
  const auto refused = [&](const std::string& metrics, const std::string& why) {
    EXPECT_THAT(complaint(head + metrics), AllOf(HasSubstr("s.yaml:4:"), HasSubstr(why))) << metrics;
  };
  refused("status: {mode: 1}", "always has a column 'status'");
  refused("steps: {mode: 1}", "always has a column 'steps'");
  refused("steps: {cost: forces}", "always has a column 'steps'");
  refused("'': {mode: 1}", "has a blank name");
  refused("nu: {mode: 1}", "already has a column 'nu', from ");
  refused("{f: {mode: 1, closed_form: 1}, f.closed_form: {mode: 2}}", "already has a column 'f.closed_form'");
  EXPECT_EQ(complaint(head + "steps: {cost: steps}"), "");
  EXPECT_THAT(complaint(kMetric + std::string("vary: {folder: [1, 2]}\ndefinitions: {a: folder}")),
              AllOf(HasSubstr("s.yaml:3:"), HasSubstr("always has a column 'folder'")));
}

TEST_F(SweepDesign, RefusesSamplesWithoutALatinHypercube) {
  const std::string rest = std::string(kMetric) + "vary: {materials.soft.nu: [0.1]}\n";
  EXPECT_THAT(complaint(rest + "samples: 5\n"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("combine: latin_hypercube, found combine: cartesian")));
  EXPECT_THAT(complaint(rest + "combine: zip\nseed: 5\n"), AllOf(HasSubstr("s.yaml:5:"), HasSubstr("combine: zip")));
}

TEST_F(SweepDesign, PointsAtWhatBroughtAMistakeIn) {
  const auto said = [&](const std::string& vary) { return complaint(kMetric + ("vary:\n  " + vary + "\n")); };
  EXPECT_THAT(said("materials.soft.mu: [0, 0.1]"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("did you mean 'nu'?"), Not(HasSubstr("impossible"))));
  EXPECT_THAT(said("materials.soft.nu: [soft]"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("expected a number"), Not(HasSubstr("impossible"))));
  EXPECT_THAT(said("materials.soft.nu: [0.1, 0.7]"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("nu 0.7"), HasSubstr("impossible: keep")));
  EXPECT_THAT(said("gravity.7: [1]"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("'7' is not an index of the list; expected 0 to 2")));
  EXPECT_THAT(said("kind: {a: {},\n    b: {mesh.cels: [1, 1, 1]}}"),
              AllOf(HasSubstr("s.yaml:5:"), HasSubstr("did you mean 'cells'?")));
  const auto other = [&](const std::string& scene) {
    try {
      expand(read_sweep(Config::from_file(
          write("t.yaml", kMetric + ("vary: {materials.soft.nu: [0.1]}\nscene: " + scene + "\n")).string())));
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(other("none.yaml"), AllOf(HasSubstr("t.yaml:3:"), HasSubstr("no such file")));
  EXPECT_THAT(other("{file: swing.yaml,\n  set: {gravty: [0, 0, 1]}}"),
              AllOf(HasSubstr("t.yaml:4:"), HasSubstr("did you mean 'gravity'?")));
}

TEST_F(SweepDesign, SaysWhereSomethingIsWrongBeforeAnythingRuns) {
  const std::string vary = "vary: {materials.soft.nu: [0, 0.1]}\n";
  EXPECT_THAT(complaint(kMetric + std::string("vary: {materials.soft.mu: [0, 0.1]}\n")),
              HasSubstr("did you mean 'nu'?"));
  EXPECT_THAT(complaint(kMetric + std::string("vary: {stifer: [0, 0.1]}\n")),
              AllOf(HasSubstr("s.yaml:3:"), HasSubstr("no formula uses it")));
  EXPECT_THAT(complaint(vary + "quantities: {f: {quantity: top.displacement.z}}"),
              AllOf(HasSubstr("s.yaml:3:"), HasSubstr("did you mean 'tip.displacement.z'?")));
  EXPECT_THAT(complaint(vary + "quantities: {f: {mode: 1, closed_form: 2*E}}"),
              HasSubstr("cannot read the formula '2*E'"));
  EXPECT_THAT(complaint(vary + "quantities: {f: {mode: 1, cost: steps}}"), HasSubstr("exactly one of"));
  EXPECT_THAT(complaint(vary + "quantities: {f: {cost: stesp}}"), HasSubstr("did you mean 'steps'?"));
  EXPECT_THAT(complaint(vary + "quantities: {f: {quantity: tip.displacement.z, take: onset}}"),
              AllOf(HasSubstr("s.yaml:3:"), HasSubstr("onset needs 'of'")));
  EXPECT_THAT(complaint(vary + "quantities: {f: {quantity: tip.displacement.z, take: max, of: 1}}"),
              HasSubstr("is used with take: drift, gain or onset only"));
  EXPECT_THAT(complaint(kMetric + std::string("vary: {materials.soft.nu: {from: 0, to: 1}}")),
              HasSubstr("'count' is missing"));
  EXPECT_THAT(complaint(kMetric + std::string("vary: {materials.soft.young: {values: [2], unit: GPas}}")),
              HasSubstr("the unit 'GPas' is not known"));
}

TEST_F(SweepDesign, ShowsAMetricOnlyInAUnitOfItsDimension) {
  const std::string head = "vary: {materials.soft.nu: [0, 0.1]}\n";
  const auto refused = [&](const std::string& metric, const std::string& why) {
    EXPECT_THAT(complaint(head + "quantities: {f: {" + metric + "}}"),
                AllOf(HasSubstr("s.yaml:3:"), HasSubstr("unit"), HasSubstr(why)))
        << metric;
  };
  refused("quantity: tip.displacement.z, unit: bananas", "'bananas' is not known");
  refused("mode: 1, unit: bananas", "'bananas' is not known");
  refused("quantity: tip.displacement.z, unit: GPa", "expected a length (m)");
  refused("quantity: tip.displacement.z, take: time_of_max, unit: mm", "expected a time (s)");
  refused("quantity: tip.displacement.z, take: onset, of: 1, unit: mm", "expected a time (s)");
  refused("quantity: tip.displacement.z, settled_within: 0.1, unit: mm", "expected a time (s)");
  refused("quantity: tip.displacement.z, take: gain, unit: mm", "expected a plain number");
  refused("mode: 1, unit: ms", "expected a frequency (Hz)");
  refused("cost: cpu_seconds, unit: kHz", "expected a time (s)");
  refused("cost: steps, unit: s", "expected a plain number");
  EXPECT_EQ(
      complaint(head + "quantities: {a: {mode: 1, unit: kHz}, b: {cost: cpu_seconds, unit: ms}, c: {quantity: "
                       "tip.displacement.z, unit: mm}, d: {quantity: tip.displacement.z, take: frequency, unit: kHz}}"),
      "");
}

TEST_F(SweepDesign, KeepsImpossiblePointsOnlyWhereThatIsAskedFor) {
  const std::string text = kMetric + std::string("vary: {materials.soft.nu: [0.3, 0.6]}\n");
  EXPECT_THAT(complaint(text), AllOf(HasSubstr("nu 0.6"), HasSubstr("impossible: keep")));
  const auto all = points(text + "impossible: keep\n");
  EXPECT_EQ(all[0].impossible, "");
  EXPECT_THAT(all[1].impossible, HasSubstr("must be in (-1, 0.5)"));
  EXPECT_THAT(complaint("vary: {materials.soft.nu: [0.6, 0.3]}\nquantities: {f: {quantity: top.displacement.z}}\n"
                        "impossible: keep"),
              HasSubstr("did you mean 'tip.displacement.z'?"));
}

TEST(ShippedSweeps, HavePointsThatCanAllBeComputed) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(ORTHODYN_SOURCE_DIR "/configs/sweeps")) {
    const auto points = expand(read_sweep(Config::from_file(entry.path().string())));
    EXPECT_GE(points.size(), 18u) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 6);
}

}  // namespace
}  // namespace orthodyn::study::sweep::sweep_design_test
