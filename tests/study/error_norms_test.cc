// Error norms of trajectories with known distances.
#include "lib/simulation/error_estimate/error_norms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/simulation/run/setup.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::error_norms_test {
namespace {

// A free cube of mass 8 kg in rigid translation s(t) along x.
struct Rigid {
  Rigid()
      : setup(set_up(Config::from_text("mesh: {type: box, size: [2, 2, 2], cells: [1, 1, 1], order: 1}\n"
                                       "materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3}}\n"
                                       "mass: consistent\ntime: {end: 1}\n"))) {}
  template <class F>
  Trajectory moving(F&& s, int n = 200) const {
    Trajectory t;
    const int dofs = setup.built.model->num_dofs();
    t.q = t.v = Eigen::MatrixXd::Zero(dofs, n + 1);
    for (int k = 0; k <= n; ++k) {
      t.times.push_back(static_cast<double>(k) / n);
      for (int i = 0; i < dofs; i += 3) t.q(i, k) = s(t.times.back()), t.v(i, k) = 2 * s(t.times.back());
    }
    return t;
  }
  ReferenceNorms norms(Trajectory reference) const {
    const auto& dofs = setup.built.model->parts().dofs->node(0);
    return {*setup.built.model, std::move(reference), {{"corner", dofs}}};
  }
  Setup setup;
};

TEST(ErrorNorms, TheMassNormOfARigidMotionIsTheRootOfItsMassTimesTheDistance) {
  const Rigid body;
  const auto norms = body.norms(body.moving([](double t) { return 3 * t; }));
  EXPECT_NEAR(norms.scales().displacement, 3 * std::sqrt(8), 1e-12);
  EXPECT_NEAR(norms.scales().velocity, 6 * std::sqrt(8), 1e-12);
  EXPECT_NEAR(norms.scales().probes[0].second, 3, 1e-12);
}

TEST(ErrorNorms, FinalRmsAndWorstAreRelativeToTheLargestMotion) {
  const Rigid body;
  const auto norms = body.norms(body.moving([](double t) { return 3 * t; }));
  // Off by 0.3 at one sample of 201, by 0.03 at the end.
  const auto errors = norms.errors(body.moving([](double t) { return 3 * t + (t == 0.5 ? 0.3 : t == 1 ? 0.03 : 0); }));
  EXPECT_NEAR(errors.displacement.final, 0.01, 1e-12);
  EXPECT_NEAR(errors.displacement.max, 0.1, 1e-12);
  EXPECT_NEAR(errors.displacement.l2, std::sqrt((0.01 + 0.0001) / 201), 1e-12);
  EXPECT_NEAR(errors.velocity.max, 0.1, 1e-12);
  EXPECT_NEAR(errors.probes[0].second.max, 0.1, 1e-12);
}

TEST(ErrorNorms, QuantitiesAreRelativeToTheirLargestSize) {
  const Rigid body;
  const auto with = [&](double last_of_vector, double number) {
    Trajectory t = body.moving([](double s) { return s; }, 2);
    t.quantities = Eigen::MatrixXd{{0, 3, 3}, {0, 0, 0}, {0, 4, last_of_vector}, {-8, 2, number}};
    return t;
  };
  const ReferenceNorms norms(*body.setup.built.model, with(4, 2), {}, {{"vector", 3}, {"number"}});
  EXPECT_EQ(norms.scales().quantities[0].second, 5);
  EXPECT_EQ(norms.scales().quantities[1].second, 8);
  const auto errors = norms.errors(with(4.5, 6)).quantities;
  EXPECT_EQ(errors[0].first, "vector");
  EXPECT_NEAR(errors[0].second.final, 0.1, 1e-15);
  EXPECT_NEAR(errors[1].second.max, 0.5, 1e-15);
  EXPECT_NEAR(errors[1].second.l2, 0.5 / std::sqrt(3), 1e-15);
}

TEST(ErrorNorms, ALateSwingIsAPhaseError) {
  const Rigid body;
  const double omega = 2 * std::numbers::pi * 6;
  const auto norms = body.norms(body.moving([&](double t) { return std::sin(omega * t); }));
  EXPECT_NEAR(norms.scales().dominant_frequency, 6, 0.01);
  EXPECT_NEAR(norms.errors(body.moving([&](double t) { return std::sin(omega * t - 0.2); })).phase, 0.2, 2e-3);
}

TEST(ErrorNorms, NothingMovesNothingIsRelativeToNothing) {
  const Rigid body;
  const auto norms = body.norms(body.moving([](double) { return 0.0; }));
  EXPECT_TRUE(std::isnan(norms.errors(body.moving([](double) { return 1.0; })).displacement.l2));
}

using TrajectoryFile = InFolder;

TEST_F(TrajectoryFile, ComesBackAsItWasWritten) {
  const Trajectory before = Rigid().moving([](double t) { return std::exp(t); }, 7);
  before.save(folder_ / "t.bin");
  const Trajectory after = Trajectory::load(folder_ / "t.bin");
  EXPECT_EQ(after.times, before.times);
  EXPECT_EQ(after.q, before.q);
  EXPECT_EQ(after.v, before.v);
}

TEST_F(TrajectoryFile, ACutOneIsRefusedWithTheRemedy) {
  Rigid().moving([](double t) { return t; }, 7).save(folder_ / "t.bin");
  EXPECT_TRUE(Trajectory::is_whole(folder_ / "t.bin"));
  fs::resize_file(folder_ / "t.bin", fs::file_size(folder_ / "t.bin") - 1);
  EXPECT_FALSE(Trajectory::is_whole(folder_ / "t.bin"));
  try {
    Trajectory::load(folder_ / "t.bin");
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("start the comparison again"), std::string::npos);
  }
}

TEST_F(TrajectoryFile, OneWithAFlippedBitIsRefused) {
  Rigid().moving([](double t) { return t; }, 3).save(folder_ / "t.bin");
  const std::string whole = read_text(folder_ / "t.bin");
  for (std::size_t at = 0; at < whole.size(); at += 5) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    std::ofstream(folder_ / "t.bin", std::ios::binary) << flipped;
    EXPECT_FALSE(Trajectory::is_whole(folder_ / "t.bin")) << at;
  }
}

}  // namespace
}  // namespace orthodyn::error_norms_test
