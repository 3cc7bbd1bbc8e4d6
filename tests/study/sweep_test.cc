// `orthodyn sweep` end to end: metrics, units, failures, earlier results.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lib/scene/expectation.h"
#include "lib/study/jobs/job_result.h"
#include "tests/study/sweep_command.h"

namespace orthodyn::sweep_test {
namespace {

TEST_F(SweepCommand, ReplacesNoTableOfAnotherFile) {
  const std::string text = "scene: scene.yaml\nvary: {time.end: [0.01]}\nquantities: {hertz: {mode: 1}}\n";
  write("s.yaml", text);
  write("t.yaml", text);
  ASSERT_EQ(orthodyn("sweep s.yaml --quiet --no-report --out both").exit_code, 0);
  const std::string before = read_text(folder_ / "both/sweep.json");
  const auto other = orthodyn("sweep t.yaml --quiet --no-report --out both");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.output.find("both: holds the results of s.yaml"), std::string::npos) << other.output;
  EXPECT_EQ(read_text(folder_ / "both/sweep.json"), before);
  EXPECT_EQ(orthodyn("sweep ./s.yaml --quiet --no-report --out both").exit_code, 0);  // the same file
}

TEST_F(SweepCommand, SaysMetricsInTheirUnit) {
  write("s.yaml",
        "scene: scene.yaml\nvary: {time.end: [0.01]}\n"
        "quantities: {hertz: {mode: 1}, kilo: {mode: 1, unit: kHz}}\n");
  const auto done = sweep();
  double hertz = 0, kilo = 0;
  const auto at = done.output.find("hertz ");
  ASSERT_NE(at, std::string::npos) << done.output;
  ASSERT_EQ(std::sscanf(done.output.c_str() + at, "hertz %lf Hz, kilo %lf kHz", &hertz, &kilo), 2) << done.output;
  EXPECT_NEAR(hertz, 1000 * kilo, 1e-4 * hertz);
}

TEST_F(SweepCommand, FindsMetricsOfEveryKind) {
  write("s.yaml", R"(scene: {file: scene.yaml, set: {damping: {mass: =2*zeta*omega}, time.end: =6/(zeta*omega)}}
vary: {zeta: [0.05, 0.2]}
definitions:               # of the one unknown: k = V K/a^2, K = C22 + G12 + G23, m = rho V/4
  omega: sqrt(4*2*1e6/1000)/0.1
quantities:
  hertz: {mode: 1}
  along: {along: x}
  end: {quantity: node.displacement.x}
  most: {quantity: node.displacement.x, take: max}
  settled: {quantity: node.displacement.x, settled_within: 0.05}
  energy: {quantity: energy.elastic, take: max}
  steps: {cost: steps}
)");
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const double omega = std::sqrt(8000.0) / 0.1;
  const Json told = table();
  for (const auto& point : told.at("points")) {
    const double zeta = point.at("values").at("zeta");
    const Json& f = point.at("metrics");
    EXPECT_NEAR(f.at("hertz").get<double>(), omega / (2 * M_PI), 1e-6 * omega);
    EXPECT_EQ(f.at("hertz"), f.at("along"));
    const double rest = f.at("end");
    // A suddenly loaded oscillator overshoots by exp(-pi zeta/sqrt(1 - zeta^2)) times its static deflection.
    const double overshoot = std::exp(-M_PI * zeta / std::sqrt(1 - zeta * zeta));
    EXPECT_NEAR(f.at("most").get<double>() / rest, 1 + overshoot, 6e-3);
    // Bounded by the envelope, which it touches at every peak.
    const double envelope = -std::log(0.05 * (1 + overshoot)) / (zeta * omega);
    EXPECT_LT(f.at("settled").get<double>(), 1.05 * envelope);
    EXPECT_GT(f.at("settled").get<double>(), envelope - 2 * M_PI / omega);
    EXPECT_GT(f.at("steps").get<double>(), 20);
    EXPECT_GT(f.at("energy").get<double>(), 0);
  }
}

TEST_F(SweepCommand, KnowsWhichMetricsFailAtOne) {
  write("s.yaml", R"(scene:
  file: scene.yaml
  set: {materials.soft.strength: {tension: 1e4, compression: 1e4, shear: 1e4}}
vary: {time.end: [0.01]}
quantities:
  exposure: {quantity: max_stress.largest, take: max}
  when: {quantity: max_stress.largest, take: time_of_max}
  stress: {quantity: von_mises.largest}
)");
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json told = table();
  for (const auto& metric : told.at("metrics"))
    EXPECT_EQ(metric.at("fails_at_one").get<bool>(), metric.at("name") == "exposure") << metric.dump();
}

TEST_F(SweepCommand, KnowsEveryTakeWithItsUnit) {
  const std::map<std::string, std::string> others{{"time_of_max", "s"}, {"time_of_min", "s"}, {"onset", "s"},
                                                  {"frequency", "Hz"},  {"drift", ""},        {"gain", ""}};
  std::string text =
      "scene: {file: scene.yaml, set: {damping.mass: 10}}\nvary: {materials.soft.nu: [0]}\nquantities:\n";
  for (const auto& [take, word] : EnumNames<TimeReduction>::list) {
    const bool compares = take == TimeReduction::drift || take == TimeReduction::gain || take == TimeReduction::onset;
    text +=
        fmt::format("  {}: {{quantity: node.displacement.x, take: {}{}}}\n", word, word, compares ? ", of: 5e-6" : "");
  }
  write("s.yaml", text);
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json told = table();
  const Json metrics = told.at("points")[0].at("metrics");
  ASSERT_EQ(told.at("metrics").size(), EnumNames<TimeReduction>::list.size());
  for (const Json& f : told.at("metrics")) {
    const std::string name = f.at("name");
    EXPECT_TRUE(metrics.at(name).is_number()) << name;
    EXPECT_EQ(f.at("unit"), others.contains(name) ? others.at(name) : "m") << name;
  }
  // Starting from zero, drift and gain equal the maximum, except that only the maximum is refined by a parabola between
  // steps. The onset precedes the maximum.
  const double most = metrics.at("max");
  ASSERT_GT(most, 5e-6);
  EXPECT_EQ(metrics.at("drift"), metrics.at("gain"));
  EXPECT_NEAR(metrics.at("gain").get<double>(), most / 5e-6, 1e-3 * most / 5e-6);
  EXPECT_GT(metrics.at("onset").get<double>(), 0);
  EXPECT_LT(metrics.at("onset").get<double>(), metrics.at("time_of_max").get<double>());
}

TEST_F(SweepCommand, HeadsTheTableWithUnitsAndEachColumnOnce) {
  write("s.yaml", R"(scene: scene.yaml
vary:
  materials.soft.young: [1e5]
  materials.soft.density: [0.5 g/cm^3]
  loads.0.force.0: [1]
  materials.soft.nu: [0]
quantities: {steps: {cost: steps}, hertz: {mode: 1}}
)");
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const std::string csv = read_text(folder_ / "out/sweeps/s/sweep.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "point,young [Pa],density [g/cm^3],force.0 [N],nu,steps,hertz "
            "[Hz],hertz.mesh_error,status,reason,message,wall_seconds [s],cpu_seconds "
            "[s],mesh_error,warnings,unknowns,folder");
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 16) << line;
}

TEST_F(SweepCommand, TellsWhatALaterPointWarnsOf) {
  write("pull.yaml", R"(
analysis: static
mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 2}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
)");
  write("s.yaml",
        "scene: pull.yaml\nvary: {materials.m.density: [1000, 0.5]}\nquantities: {sag: {quantity: "
        "tip.displacement.z}}\n");
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  EXPECT_NE(done.output.find("warning: 1 of 2 points have further warnings"), std::string::npos) << done.output;
  EXPECT_TRUE(table().at("points")[0].at("warnings").empty());
  EXPECT_NE(table().at("points")[1].at("warnings")[0].get<std::string>().find("density"), std::string::npos);
}

TEST_F(SweepCommand, TellsOfACoarseMesh) {
  const std::string bending = R"(
analysis: static
mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: ORDER}
materials: {soft: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
)";
  for (const bool coarse : {false, true}) {
    std::string scene = bending;
    scene.replace(scene.find("ORDER"), 5, coarse ? "1" : "2, cells: [10, 2, 2]");
    if (!coarse) scene.replace(scene.find("cells: [4, 1, 1], "), 18, "");
    write("bend.yaml", scene);
    write("s.yaml",
          "scene: bend.yaml\nvary: {materials.soft.young: [1e9, 2e9]}\nquantities: {sag: {quantity: "
          "tip.displacement.z}}\n");
    const auto done = sweep();
    ASSERT_EQ(done.exit_code, 0) << done.output;
    EXPECT_EQ(done.output.find("warning: the mesh is coarse") != std::string::npos, coarse) << done.output;
    EXPECT_EQ(table().at("points")[0].at("mesh_error").get<double>() > 0.05, coarse);
  }
}

// Frequencies as well, though there is no motion with recovered stresses.
TEST_F(SweepCommand, TellsHowFarTheMeshPutsFrequenciesOff) {
  for (const bool coarse : {false, true}) {
    write("bar.yaml", std::string("mesh: {type: box, size: [1, 0.1, 0.1], cells: ") +
                          (coarse ? "[4, 1, 1], order: 1" : "[8, 1, 1]") + R"(}
materials: {soft: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
)");
    write("s.yaml", "scene: bar.yaml\nvary: {materials.soft.young: [1e9, 2e9]}\nquantities: {hertz: {mode: 1}}\n");
    const auto done = sweep();
    ASSERT_EQ(done.exit_code, 0) << done.output;
    EXPECT_EQ(done.output.find("the mesh is coarse for frequencies of 2 of 2 points: up to ") != std::string::npos,
              coarse)
        << done.output;
    const double error = table().at("points")[0].at("metric_errors").at("hertz");
    EXPECT_EQ(error > 0.05, coarse) << error;
    EXPECT_GT(error, 1e-4);
  }
}

TEST_F(SweepCommand, IntegratesNothingWhereOnlyFrequenciesAreAskedFor) {
  write("s.yaml",
        "scene: scene.yaml\nvary: {time.end: [1e9]}\nquantities: {hertz: {mode: 1}}\nlimits: {seconds: 10}\n");
  ASSERT_EQ(sweep().exit_code, 0);
  EXPECT_EQ(table().at("points")[0].at("status"), "completed");
  EXPECT_FALSE(table().at("points")[0].at("cost").contains("steps"));
}

TEST_F(SweepCommand, AnswersEachModeAloneAsAmongOthers) {
  write("free.yaml", R"(mesh: {type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
time: {end: 0.1}
integrator: {type: cvode_bdf}
)");
  const std::string head = "scene: free.yaml\nvary: {materials.soft.nu: [0.3]}\nquantities: ";
  const auto metrics_of = [&](const std::string& quantities) {
    write("s.yaml", head + quantities + "\n");
    const auto done = sweep();
    EXPECT_EQ(done.exit_code, 0) << done.output;
    EXPECT_EQ(table().at("points")[0].at("status"), "completed") << done.output;
    return table().at("points")[0].at("metrics");
  };
  const Json both = metrics_of("{first: {mode: 1}, seventh: {mode: 7}, beyond: {mode: 900}, along: {along: x}}");
  const double first = both.at("first"), seventh = both.at("seventh"), along = both.at("along");
  EXPECT_GT(first, 1);
  EXPECT_GT(seventh, first);
  EXPECT_TRUE(both.at("beyond").is_null());  // of 36 unknowns
  EXPECT_NEAR(metrics_of("{first: {mode: 1}}").at("first").get<double>(), first, 1e-6 * first);
  EXPECT_NEAR(metrics_of("{seventh: {mode: 7}}").at("seventh").get<double>(), seventh, 1e-6 * seventh);
  EXPECT_NEAR(metrics_of("{along: {along: x}}").at("along").get<double>(), along, 1e-6 * along);
}

// Euler: pi^2 E I/(4 L^2) for a load of 1 N, about each of the two axes of the cross-section.
TEST_F(SweepCommand, HasCriticalLoadFactors) {
  write("column.yaml", R"(analysis: buckling
mesh: {type: box, size: [1, 0.04, 0.02], cells: [10, 1, 1]}
materials: {soft: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-1, 0, 0]}]
)");
  write("s.yaml", R"(scene: column.yaml
vary: {materials.soft.young: [1e9]}
quantities: {weak: {buckling: 1}, strong: {buckling: 2}}
)");
  const auto done = sweep();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json metrics = table().at("points")[0].at("metrics");
  const auto euler = [](double width, double height) {
    return std::numbers::pi * std::numbers::pi * 1e9 * width * std::pow(height, 3) / 12 / 4;
  };
  EXPECT_NEAR(metrics.at("weak").get<double>(), euler(0.04, 0.02), 0.02 * euler(0.04, 0.02));
  // The next shape about the weak axis has 9 times its first factor, the strong axis 4 times.
  EXPECT_NEAR(metrics.at("strong").get<double>(), euler(0.02, 0.04), 0.02 * euler(0.02, 0.04));
}

TEST_F(SweepCommand, KeepsFailuresWithTheirReasons) {
  write("s.yaml", R"(scene: scene.yaml
vary:
  kind: {good: {time.end: 0.01}, long: {time.end: 1e5}, sick: {materials.soft.nu: 0.7}}
quantities: {far: {quantity: node.displacement.x, take: max}}
impossible: keep
limits: {seconds: 0.5}
)");
  const auto done = sweep();
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_NE(done.output.find("warning: kind sick"), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("1 of 2 points failed; first: kind long: time limit: "), std::string::npos) << done.output;
  const Json points = table().at("points");
  EXPECT_EQ(points[0].at("status"), "completed");
  EXPECT_EQ(points[1].at("reason"), "time limit");
  EXPECT_EQ(points[2].at("reason"), "impossible");
  EXPECT_NE(read_text(folder_ / "out/sweeps/s/sweep.csv").find("long,,failed,time limit"), std::string::npos);
}

TEST_F(SweepCommand, LimitsTheTimeOfStaticPoints) {
  write("still.yaml", R"(analysis: static
mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
gravity: [0, 0, -0.1]
clamps: [{surface: x0}]
output: {probes: {tip: {at: [1, 0, 0]}}}
)");
  const std::string text =
      "scene: still.yaml\nvary: {materials.soft.nu: [0]}\n"
      "quantities: {sag: {quantity: tip.displacement.z}}\nlimits: {seconds: ";
  write("s.yaml", text + "60}\n");
  ASSERT_EQ(sweep().exit_code, 0);
  EXPECT_EQ(table().at("points")[0].at("status"), "completed");
  write("s.yaml", text + "1e-6}\n");
  const auto late = sweep();
  EXPECT_EQ(late.exit_code, 3);  // nothing was measured
  EXPECT_NE(late.output.find("1 of 1 points failed; first: nu 0: time limit: reached t = "), std::string::npos)
      << late.output;
  EXPECT_EQ(sweep("--collect").exit_code, 3);
  EXPECT_EQ(table().at("points")[0].at("reason"), "time limit");
}

TEST_F(SweepCommand, DoesNotRepeatPointsOfAnEarlierOrSmallerSweep) {
  write("s.yaml", "scene: scene.yaml\nvary: {materials.soft.young: [1e5, 1e6]}\nquantities: {hertz: {mode: 1}}\n");
  sweep();
  const auto before = results();
  write("s.yaml", "scene: scene.yaml\nvary: {materials.soft.young: [1e5, 1e6, 1e7]}\nquantities: {hertz: {mode: 1}}\n");
  const auto more = sweep("--jobs 1");
  EXPECT_NE(more.output.find("[2/3] young 1000000: hertz"), std::string::npos) << more.output;
  EXPECT_NE(more.output.find("(done before)"), std::string::npos);
  for (const auto& [file, text] : before) EXPECT_EQ(read_text(file), text);
}

TEST_F(SweepCommand, TriesFailuresAgainWhereThatIsAskedFor) {
  write("s.yaml", "scene: scene.yaml\nvary: {materials.soft.young: [1e5, 1e6]}\nquantities: {hertz: {mode: 1}}\n");
  ASSERT_EQ(sweep().exit_code, 0);
  const auto whole = results();
  study::write_result(fs::path(whole.begin()->first).parent_path(),
                      study::to_json(study::Failure{"time limit", "on a slow machine"}));
  const auto kept = sweep();
  EXPECT_EQ(kept.exit_code, 0);
  EXPECT_NE(kept.output.find(": time limit: on a slow machine"), std::string::npos) << kept.output;
  EXPECT_NE(kept.output.find("kept 1 failure of an earlier run"), std::string::npos) << kept.output;
  const auto again = sweep("--retry");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.output.find("failed"), std::string::npos) << again.output;
  EXPECT_EQ(results().rbegin()->second, whole.rbegin()->second);  // that did not fail
}

TEST_F(SweepCommand, LeavesNoOldReportBesideNewResults) {
  write("s.yaml", "scene: scene.yaml\nvary: {materials.soft.young: [1e5]}\nquantities: {hertz: {mode: 1}}\n");
  ASSERT_EQ(sweep().exit_code, 0);
  write("out/sweeps/s/report.html", "old");
  const auto done = sweep();
  EXPECT_NE(done.output.find("is now out/sweeps/s/report.old.html"), std::string::npos) << done.output;
  EXPECT_FALSE(fs::exists(folder_ / "out/sweeps/s/report.html"));
  EXPECT_EQ(read_text(folder_ / "out/sweeps/s/report.old.html"), "old");
}

TEST_F(SweepCommand, HasNoMoreTasksThanPoints) {
  write("s.yaml", kMany);
  const auto done = sweep("--slurm --tasks 100");
  EXPECT_NE(done.output.find("12 points need only 12 tasks, not 100\n"), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("#SBATCH --array=1-12\n"), std::string::npos) << done.output;
}

TEST_F(SweepCommand, AFileOfAnotherKindIsToldFromItsKeys) {
  write("sweep.yaml", kMany);
  write("compare.yaml", "scenes: [scene.yaml]\ntolerances: [1e-3]\n");
  write("stability.yaml", "cases: [scene.yaml]\n");
  write("run.yaml", kOscillator);
  const std::map<std::string, std::string> words{
      {"run", "a scene"}, {"compare", "a comparison"}, {"sweep", "a sweep"}, {"stability", "a file of hard cases"}};
  for (const auto& [command, unused] : words) {
    for (const auto& [kind, what] : words) {
      if (command == kind) continue;
      const auto refused = orthodyn(command + " " + kind + ".yaml");
      EXPECT_EQ(refused.exit_code, 2);
      EXPECT_NE(refused.output.find("this is " + what + "; run it with `orthodyn " + kind + " " + kind + ".yaml`"),
                std::string::npos)
          << refused.output;
    }
  }
  for (const char* command : {"check", "modes", "verify"})
    EXPECT_NE(orthodyn(std::string(command) + " sweep.yaml").output.find("orthodyn sweep"), std::string::npos);
  write("s.yaml", "scene: stability.yaml\nvary: {materials.soft.nu: [0]}\nquantities: {f: {mode: 1}}\n");
  EXPECT_NE(sweep().output.find("s.yaml:1:8: scene: stability.yaml: this is a file of hard cases"), std::string::npos);
}

TEST_F(SweepCommand, EveryCommandHasExamplesOfItsOwn) {
  for (const std::string command :
       {"run", "check", "modes", "compare", "sweep", "stability", "verify", "convert", "list", "schema", "init"}) {
    const std::string help = orthodyn(command + " --help").output;
    const auto examples = help.find("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << help;
    std::istringstream lines(help.substr(examples + 10));
    for (std::string line; std::getline(lines, line);) {
      const std::string ranks = "  mpirun -n 2 ", own = "orthodyn " + command + " ";
      EXPECT_TRUE(line.empty() || line.starts_with("  " + own) || line.starts_with(ranks + own)) << line;
    }
  }
}

TEST_F(SweepCommand, TheListsHaveTheLimits) {
  for (const char* kind : {"sweep", "stability"})
    EXPECT_NE(orthodyn(std::string("list ") + kind).output.find("Wall time limit of one integration"),
              std::string::npos);
}

// Repeated kills, each after one more finished point, keep every finished point and leave at most as many unfinished
// ones as there are processes.
}  // namespace
}  // namespace orthodyn::sweep_test
