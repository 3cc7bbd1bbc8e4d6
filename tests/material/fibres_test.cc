// Tensions of fibres compared with formulas, quadrature and the properties of their sources.
#include "lib/material/fibres/fibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "lib/material/fibres/monotone_cubic.h"
#include "tests/config/messages.h"

namespace orthodyn::fibres_test {
namespace {

Fibres fibres(const std::string& yaml) { return Fibres::spec().read(Config::from_text(yaml).resolving()); }

std::shared_ptr<const StretchFunction> passive(const std::string& yaml) {
  return fibres("passive: " + yaml).passive->stress();
}

std::shared_ptr<const StretchFunction> length(const std::string& yaml) {
  return fibres("active: {stress: 1, length: " + yaml + "}").active->length->factor();
}

std::shared_ptr<const RateFunction> velocity(const std::string& yaml) {
  return fibres("active: {stress: 1, velocity: " + yaml + "}").active->velocity->factor();
}

std::string refusal_of(const std::string& yaml) {
  return refusal([&] { fibres(yaml); });
}

// The composite rule of Gauss with two points.
double quadrature(const StretchFunction& g, double from, double to, int pieces = 2000) {
  const double h = (to - from) / pieces, offset = 0.5 * h / std::sqrt(3.0);
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = from + (i + 0.5) * h;
    sum += 0.5 * h * (g.value(middle - offset) + g.value(middle + offset));
  }
  return sum;
}

double difference_quotient(const StretchFunction& g, double x, double h) {
  return (g.value(x + h) - g.value(x - h)) / (2 * h);
}

const std::string kExponential = "{type: exponential, k1: 1e3, k2: 2}";
const std::string kMeasured = "{type: curve, points: [[1, 0], [1.05, 100], [1.1, 500], [1.2, 2500], [1.25, 2500]]}";
const std::string kGaussian = "{type: gaussian, optimal_stretch: 1.1, width: 0.4}";
const std::string kTable = "{type: table, points: [[0.5, 0], [0.8, 0.7], [1, 1], [1.1, 1], [1.6, 0]]}";

std::vector<std::shared_ptr<const StretchFunction>> all_functions() {
  return {passive(kExponential), passive(kMeasured), length(kGaussian), length(kTable), length("{type: gaussian}")};
}

// Expected values: the formula of Holzapfel, Gasser & Ogden, evaluated outside of this program.
TEST(Fibres, ExponentialTensionAndEnergyAreThoseOfTheFormula) {
  const auto g = passive(kExponential);
  const double stretch[] = {1.05, 1.2, 1.4}, energy[] = {5.30870424823936, 118.2127580061208, 1329.1798640382137},
               tension[] = {219.82079435773417, 1555.330689817854, 16979.341898138868};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(g->integral(stretch[i] - 1), energy[i], 1e-12 * energy[i]);
    EXPECT_NEAR(g->value(stretch[i] - 1), tension[i], 1e-12 * tension[i]);
  }
  EXPECT_NEAR(g->value(1e-9), 4e3 * 1e-9, 1e-14);  // modulus 4 k1
  EXPECT_EQ(g->slope(0), 4e3);
}

TEST(Fibres, BearNoCompression) {
  for (const auto& yaml : {kExponential, kMeasured})
    for (const double x : {-0.9, -0.1, -1e-12}) {
      const auto g = passive(yaml);
      EXPECT_EQ(g->value(x), 0);
      EXPECT_EQ(g->slope(x), 0);
      EXPECT_EQ(g->integral(x), 0);
      EXPECT_EQ(g->mean(x, 0.5 * x), 0);
    }
}

TEST(Fibres, SlopesAndIntegralsAreThoseOfTheValues) {
  for (const auto& g : all_functions())
    for (const double x : {-0.37, -0.12, 0.013, 0.07, 0.16, 0.31}) {
      const double coarse = std::abs(difference_quotient(*g, x, 1e-3) - g->slope(x)),
                   fine = std::abs(difference_quotient(*g, x, 5e-4) - g->slope(x));
      if (fine > 1e-9 * (1 + std::abs(g->slope(x)))) {
        EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << x;
      }
      // in two parts, for the kink at 0
      const double work = quadrature(*g, -1, std::min(x, 0.0)) + quadrature(*g, 0, std::max(x, 0.0));
      EXPECT_NEAR(g->integral(x), work, 1e-7 * (1e-3 + std::abs(work))) << x;
    }
}

TEST(Fibres, MeansHoldTheEnergyToRoundOffForAnyPairOfStretches) {
  for (const auto& g : all_functions())
    for (const double x0 : {-0.3, -1e-3, 0.0, 0.05, 0.11, 0.3})
      for (const double h : {0.2, -0.2, 1e-2, 1e-4, -1e-6, 1e-9, 0.0}) {
        const double mean = g->mean(x0, x0 + h), change = g->integral(x0 + h) - g->integral(x0);
        EXPECT_NEAR(mean * h, change, 1e-15 * (g->integral(x0) + g->integral(x0 + h) + 1)) << x0 << " " << h;
        const double middle = g->value(x0 + 0.5 * h);
        if (std::abs(h) <= 1e-6 && x0 != 0) {
          EXPECT_NEAR(mean, middle, 1e-9 * (1 + middle)) << x0 << " " << h;
        }
      }
}

TEST(MonotoneCubic, IsExactForLinearData) {
  using Ends = MonotoneCubic::Ends;
  const MonotoneCubic f({{0, 1}, {0.3, 1.6}, {1, 3}, {4, 9}}, Ends::with_end_slopes, Ends::with_end_slopes);
  for (const double x : {-1.0, 0.1, 0.3, 0.7, 3.9, 7.0}) {
    EXPECT_NEAR(f.value(x), 1 + 2 * x, 1e-14 * 20);
    EXPECT_NEAR(f.slope(x), 2, 1e-14 * 20);
  }
  EXPECT_NEAR(f.integral(-1, 5), 6 + 24, 1e-13);
  EXPECT_NEAR(f.integral(5, -1), -30, 1e-13);
  EXPECT_NEAR(f.largest_slope(), 2, 1e-14);
}

TEST(MonotoneCubic, PassesThroughThePointsAndStaysMonotone) {
  const std::vector<MonotoneCubic::Point> points{{0, 0}, {1, 0.01}, {1.5, 5}, {1.6, 5}, {3, 5.1}, {3.01, 80}};
  const MonotoneCubic f(points, MonotoneCubic::Ends::constant, MonotoneCubic::Ends::constant);
  for (const auto& [x, y] : points) EXPECT_NEAR(f.value(x), y, 1e-13);
  double largest = 0;
  for (double x = 0, last = 0; x < 3.01; x += 1e-3) {
    EXPECT_GE(f.value(x), last - 1e-13) << x;
    last = f.value(x);
    largest = std::max(largest, f.slope(x));
  }
  EXPECT_GE(f.largest_slope(), largest);
  EXPECT_LE(f.largest_slope(), 3 * (80 - 5.1) / 0.01);  // the limit of Fritsch & Carlson
}

TEST(MonotoneCubic, ReproducesAParabolaToThirdOrder) {
  const auto error = [](int n) {
    std::vector<MonotoneCubic::Point> points;
    for (int i = 0; i <= n; ++i) points.push_back({1.0 + 1.0 * i / n, std::pow(1.0 + 1.0 * i / n, 2)});
    const MonotoneCubic f(points, MonotoneCubic::Ends::constant, MonotoneCubic::Ends::constant);
    double largest = 0;
    for (double x = 1; x < 2; x += 1e-3) largest = std::max(largest, std::abs(f.value(x) - x * x));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 3, 0.3);
}

TEST(Fibres, AMeasuredCurveContinuesWithItsEndSlope) {
  const auto g = passive("{type: curve, points: [[1.1, 300], [1.2, 600]]}");  // with [1, 0]: a line
  for (const double x : {0.05, 0.15, 0.9}) EXPECT_NEAR(g->value(x), 3000 * x, 1e-9);
}

TEST(Fibres, ACurveFromAFileIsThatOfTheList) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto list = passive("{type: curve, points: [[1, 0], [1.1, 10], [1.2, 40]]}");
  for (const char* text : {"stretch,stress\n1,0\n1.1,10\n1.2,40\n", "stress,strain\n0,0\n10,0.1\n40,0.2\n"}) {
    const auto path = folder / "orthodyn_fibre_curve.csv";
    std::ofstream(path) << text;
    const auto file = passive("{type: curve, file: " + path.string() + "}");
    for (const double x : {0.03, 0.15, 0.4}) EXPECT_NEAR(file->value(x), list->value(x), 1e-12);
    std::filesystem::remove(path);
  }
}

// Thelen (2003): exp(-(L - 1)^2 / 0.45).
TEST(Fibres, TheDefaultForceLengthFactorIsThatOfThelen) {
  const auto g = length("{type: gaussian}");
  for (const double L : {0.5, 0.8, 1.0, 1.3}) EXPECT_NEAR(g->value(L - 1), std::exp(-(L - 1) * (L - 1) / 0.45), 2e-3);
  const auto shifted = length(kGaussian);
  EXPECT_EQ(shifted->value(0.1), 1);
  EXPECT_NEAR(shifted->value(1.1 * 1.4 - 1), std::exp(-1.0), 1e-14);
  EXPECT_NEAR(shifted->slope_bound(), std::abs(shifted->slope(1.1 - 1.1 * 0.4 / std::sqrt(2.0) - 1)), 1e-12);
}

// Hill (1938): (F + a)(v + b) = (F0 + a) b, here with F0 = 1, a = 0.25 and F = 0 at v = 10.
TEST(Fibres, ShorteningFollowsHillsHyperbola) {
  const auto f = velocity("{type: hill, shortening_velocity: 10, curvature: 0.25}");
  const double a = 0.25, b = 2.5;
  for (const double v : {0.0, 0.5, 2.0, 7.0, 10.0}) EXPECT_NEAR((f->value(-v) + a) * (v + b), (1 + a) * b, 1e-13);
  EXPECT_EQ(f->value(0), 1);
  EXPECT_EQ(f->value(-12), 0);
}

TEST(Fibres, LengtheningRaisesTheForceSmoothlyToItsLimit) {
  const auto f = velocity("{type: hill, shortening_velocity: 10, lengthening_factor: 1.6}");
  EXPECT_NEAR(f->value(1e9), 1.6, 1e-7);
  EXPECT_NEAR(f->slope(1e-12), f->slope(-1e-12), 1e-9);
  EXPECT_NEAR(f->slope(0), (1 + 1 / 0.25) / 10, 1e-14);
  for (const double rate : {-9.0, -3.0, -0.2, 0.4, 5.0}) {
    const auto quotient = [&](double h) { return (f->value(rate + h) - f->value(rate - h)) / (2 * h); };
    EXPECT_NEAR(std::log2(std::abs((quotient(1e-2) - f->slope(rate)) / (quotient(5e-3) - f->slope(rate)))), 2, 0.1);
  }
}

TEST(Fibres, RefuseCurvesThatAreNone) {
  const auto curve = [](const std::string& points) {
    return refusal_of("passive: {type: curve, points: " + points + "}");
  };
  EXPECT_TRUE(holds(curve("[[1, 0]]"), "has one point; a curve needs at least two"));
  EXPECT_TRUE(holds(curve("[[1, 0], [1.2, 5], [1.2, 6]]"), "points[2]: the stretch 1.2 does not exceed"));
  EXPECT_TRUE(holds(curve("[[1, 0], [1.2, 5], [1.3, 4]]"), "points[2]: the stress falls from 5 to 4"));
  EXPECT_TRUE(holds(curve("[[1, 0], [1.2, -5]]"), "points[1]: the stress -5 is negative"));
  EXPECT_TRUE(holds(curve("[[0.9, 0], [1.2, 5]]"), "begins at the stretch 0.9"));
  EXPECT_TRUE(holds(curve("[[1, 3], [1.2, 5]]"), "has the stress 3 Pa at the stretch 1"));
  EXPECT_TRUE(holds(refusal_of("passive: {type: curve}"), "give one of points and file"));
  EXPECT_TRUE(holds(refusal_of("{}"), "give passive, active or both"));
  EXPECT_TRUE(holds(refusal_of("active: {stress: 1, velocity: {type: table, points: [[-1, 0], [1, 2]]}}"),
                    "lacks the point of rate 0 and factor 1"));
  EXPECT_TRUE(holds(refusal_of("passive: {type: exponential, k1: 5, k2: 0}"), "k2"));
}

TEST(Fibres, RefuseFilesByTheirLine) {
  const auto path = std::filesystem::temp_directory_path() / "orthodyn_fibre_refused.csv";
  const auto refused = [&](const std::string& text) {
    std::ofstream(path) << text;
    return refusal_of("passive: {type: curve, file: " + path.string() + "}");
  };
  EXPECT_TRUE(holds(refused("stretch,stress\n1,0\n1.2,5\n1.1,6\n"), ".csv:4: the stretch 1.1 does not exceed"));
  EXPECT_TRUE(holds(refused("stress\n1\n2\n"), "needs either the column 'stretch' or the column 'strain'"));
  EXPECT_TRUE(holds(refused("strain,stretch,stress\n0,1,0\n0.1,1.1,2\n"), "needs either the column"));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace orthodyn::fibres_test
