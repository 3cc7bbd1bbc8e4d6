// Which computed mode is a measured one: assignments, the modal assurance criterion, and matching by frequency.
#include "lib/study/quantities/mode_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "lib/study/quantities/assignment.h"

namespace orthodyn::mode_matching_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Eigen::MatrixXd random_matrix(std::mt19937_64& generator, Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

double sum_of(const Eigen::MatrixXd& entries, const std::vector<Eigen::Index>& columns) {
  double sum = 0;
  for (std::size_t r = 0; r < columns.size(); ++r) sum += entries(static_cast<Eigen::Index>(r), columns[r]);
  return sum;
}

// Calls `see` with every choice of different columns for the rows.
template <class See>
void for_each_assignment(Eigen::Index rows, Eigen::Index columns, const See& see) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(columns));
  std::iota(order.begin(), order.end(), 0);
  do see(std::vector<Eigen::Index>(order.begin(), order.begin() + rows));
  while (std::ranges::next_permutation(order).found);
}

TEST(Assignment, HasTheLargestSumOfAll) {
  std::mt19937_64 generator(3);
  for (int repetition = 0; repetition < 30; ++repetition) {
    const Eigen::Index rows = 1 + repetition % 5;
    const Eigen::MatrixXd gains = random_matrix(generator, rows, 6);
    double best = -kInfinite;
    for_each_assignment(rows, 6, [&](const auto& columns) { best = std::max(best, sum_of(gains, columns)); });
    auto found = largest_assignment(gains);
    EXPECT_NEAR(sum_of(gains, found), best, 1e-12);
    std::ranges::sort(found);
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  }
}

TEST(Assignment, AscendingHasTheSmallestSumOfAllAscendingOnes) {
  std::mt19937_64 generator(5);
  for (int repetition = 0; repetition < 30; ++repetition) {
    const Eigen::Index rows = 1 + repetition % 5;
    Eigen::MatrixXd costs = random_matrix(generator, rows, 6);
    costs = (costs.array() > 0.6).select(kInfinite, costs);
    double best = kInfinite;
    for_each_assignment(rows, 6, [&](const auto& columns) {
      if (std::ranges::is_sorted(columns)) best = std::min(best, sum_of(costs, columns));
    });
    const auto found = smallest_ascending_assignment(costs);
    ASSERT_EQ(found.has_value(), std::isfinite(best));
    if (!found) continue;
    EXPECT_NEAR(sum_of(costs, *found), best, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(*found, std::ranges::less_equal()));
  }
}

// Amplitudes of cos(k pi x) at points, by mode.
Eigen::MatrixXd cosines(int points, int modes) {
  return Eigen::MatrixXd::NullaryExpr(points, modes, [&](Eigen::Index p, Eigen::Index k) {
    return std::cos(static_cast<double>(k + 1) * M_PI * static_cast<double>(p) / (points - 1));
  });
}

std::vector<double> as_list(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

TEST(ModalAssurance, DoesNotDependOnScaleAndSign) {
  const Eigen::MatrixXd shapes = cosines(9, 3);
  const std::vector<double> a = as_list(shapes.col(0) + 0.3 * shapes.col(1));
  const double mac = modal_assurance(a, shapes.col(0));
  EXPECT_GT(mac, 0.8);
  EXPECT_LT(mac, 0.99);
  for (const double scale : {-1.0, 1e-8, -3e9}) {
    EXPECT_NEAR(modal_assurance(a, scale * shapes.col(0)), mac, 1e-14);
    EXPECT_NEAR(modal_assurance(as_list(scale * Eigen::Map<const Eigen::VectorXd>(a.data(), 9)), shapes.col(0)), mac,
                1e-14);
  }
}

// (a . b)^2 / (a . a) (b . b) by hand: a = (1, 2, 2), b = (2, 1, 2): 64 / 81; without the second point 36 / 40.
TEST(ModalAssurance, LeavesOutPointsThatWereNotMeasured) {
  const Eigen::Vector3d b(2, 1, 2);
  EXPECT_NEAR(modal_assurance({1, 2, 2}, b), 64.0 / 81, 1e-15);
  EXPECT_NEAR(modal_assurance({1, kNaN, 2}, b), 36.0 / 40, 1e-15);
  EXPECT_EQ(modal_assurance({kNaN, 1, kNaN}, Eigen::Vector3d(2, 0, 2)), 0);
}

ModeMatching measured_of(const std::vector<double>& frequencies, const std::vector<std::vector<double>>& shapes) {
  ModeMatching out;
  out.frequencies = frequencies, out.shapes = shapes, out.band = 0.2;
  return out;
}

std::vector<int> modes_of(const std::vector<ModeMatch>& matches) {
  std::vector<int> out;
  for (const ModeMatch& match : matches) out.push_back(match.mode);
  return out;
}

// Measured are cosines 1, 3, (not measured), 2 with other signs, scales and gaps.
TEST(Matching, ByShapeFindsSwappedModes) {
  const Eigen::MatrixXd shapes = cosines(9, 5);
  std::vector<double> second = as_list(-7 * shapes.col(2));
  second[4] = kNaN;
  const auto measured =
      measured_of({100, 200, kNaN, 210}, {as_list(0.1 * shapes.col(0)), second, {}, as_list(3 * shapes.col(1))});
  const Eigen::MatrixXd macs = modal_assurances(measured, shapes, std::vector<double>(5, 1));
  const auto found = match_by_shape(measured, {90, 190, 195, 400, 500}, macs);
  EXPECT_EQ(modes_of(found), (std::vector<int>{1, 3, 0, 2}));
  for (const std::size_t k : {0u, 1u, 3u}) {
    EXPECT_NEAR(found[k].mac, 1, 1e-14);
    EXPECT_LT(found[k].next_mac, 0.5);
  }
}

// Row 1 prefers column 1 (0.9), but the sum is larger if it takes column 2 (0.8 + 0.7 instead of 0.9 + 0.1).
TEST(Matching, ByShapeMaximisesTheSumAndNamesTheNextMode) {
  const auto measured = measured_of({100, 100}, {{1}, {1}});
  Eigen::MatrixXd macs(2, 3);
  macs << 0.9, 0.8, 0, 0.7, 0.1, 0;
  const auto found = match_by_shape(measured, {100, 100, 100}, macs);
  EXPECT_EQ(modes_of(found), (std::vector<int>{2, 1}));
  EXPECT_EQ(found[0].mac, 0.8);
  EXPECT_EQ(found[0].next, 1);
  EXPECT_EQ(found[0].next_mac, 0.9);
}

// Two points see no difference between cos(pi x) and cos(3 pi x).
TEST(Matching, ByShapeTakesTheNearerFrequencyOfEqualShapes) {
  const Eigen::MatrixXd shapes = cosines(2, 3);
  const auto measured = measured_of({300}, {as_list(shapes.col(0))});
  const Eigen::MatrixXd macs = modal_assurances(measured, shapes, {1, 1, 1});
  EXPECT_EQ(match_by_shape(measured, {140, 200, 310}, macs)[0].next, 2);  // 140 is below half of 300
  const auto found = match_by_shape(measured, {160, 200, 310}, macs);
  EXPECT_EQ(found[0].mode, 3);
  EXPECT_EQ(found[0].next, 1);
  EXPECT_NEAR(found[0].next_mac, 1, 1e-14);
}

// A mode that moves across the measured direction has round-off there, which is no shape.
TEST(Matching, ByShapeCountsRoundOffAsZero) {
  const Eigen::MatrixXd shapes = cosines(9, 2);
  const auto measured = measured_of({300}, {as_list(shapes.col(0))});
  const Eigen::MatrixXd macs = modal_assurances(measured, 1e-9 * shapes, {1, 1e-9});
  EXPECT_EQ(macs(0, 0), 0);
}

TEST(Matching, ByFrequencyLeavesOutAModeThatWasNotMeasured) {
  const auto measured = measured_of({100, kNaN, 205, 400}, {});
  const auto found = match_by_frequency(measured, {95, 150, 195, 390, 600});
  EXPECT_EQ(modes_of(found), (std::vector<int>{1, 0, 3, 4}));
}

// 101 is nearer to 100 than 92 is, but then 104 has no mode of its own.
TEST(Matching, ByFrequencyIsOneToOne) {
  const auto measured = measured_of({100, 104}, {});
  EXPECT_EQ(modes_of(match_by_frequency(measured, {92, 101})), (std::vector<int>{1, 2}));
}

TEST(Matching, ByFrequencyNamesTheFrequencyWithoutAMode) {
  const auto far = match_by_frequency(measured_of({100, 200, 900}, {}), {110, 260, 270, 900});
  EXPECT_EQ(far[1].mode, 0);
  EXPECT_NE(far[1].failure.find("measured frequency 2 (200 Hz); the nearest one is mode 2, 260 Hz"), std::string::npos)
      << far[1].failure;
  const auto taken = match_by_frequency(measured_of({100, 101}, {}), {110, 500});
  EXPECT_NE(taken[0].failure.find("measured frequency 2 (101 Hz) has no computed mode of its own"), std::string::npos)
      << taken[0].failure;
  EXPECT_NE(match_by_frequency(measured_of({100}, {}), {})[0].failure.find("no elastic modes"), std::string::npos);
}

TEST(Matching, ByShapeNamesTooSmallAModel) {
  const auto found = match_by_shape(measured_of({100, 200}, {{1}, {1}}), {100}, Eigen::MatrixXd::Ones(2, 1));
  EXPECT_NE(found[0].failure.find("fewer than the 2 measured"), std::string::npos);
}

}  // namespace
}  // namespace orthodyn::mode_matching_test
