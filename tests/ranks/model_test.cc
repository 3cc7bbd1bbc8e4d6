// A model distributed over several MPI ranks gives the same forces, matrices, energies and outputs as the undivided
// model. Each rank builds both and compares them. Run with mpirun: one process would compare the model with itself.
#include <gtest/gtest.h>

#include <limits>

#include "lib/core/errors.h"
#include "lib/linear/mpi_world.h"
#include "lib/scene/build.h"
#include "tests/material/constants.h"
#include "tests/ranks/scenes.h"

namespace orthodyn {
namespace {

constexpr double kRoundOff = 1e-11;

class SharedModel : public testing::TestWithParam<SharedScene> {
 protected:
  SharedModel()
      : scene_(read_scene(Config::from_text(GetParam().yaml, "scene.yaml"))),
        one_(build(scene_)),
        parts_(build(scene_, mpi_world())) {}

  const FemModel& one() const { return *one_.model; }
  const FemModel& parts() const { return *parts_.model; }

  // A state of the undivided model, close to rest, equal on all ranks.
  State some_state() const {
    Random random(5);
    State state{0.03, Vector(one().num_dofs()), Vector(one().num_dofs())};
    for (double& x : state.q) x = 0.01 * random.between(-1, 1);
    for (double& x : state.v) x = random.between(-1, 1);
    return state;
  }

  static void expect_same(const Vector& found, const Vector& expected) {
    ASSERT_EQ(found.size(), expected.size());
    const double size = std::max(expected.lpNorm<Eigen::Infinity>(), 1e-300);
    EXPECT_LE((found - expected).lpNorm<Eigen::Infinity>(), kRoundOff * size) << "of " << size;
  }

  Vector whole(const Vector& part) const { return parts().whole({0, part, part}).q; }

  Scene scene_;
  BuiltScene one_, parts_;
};

TEST_P(SharedModel, StartsAlike) {
  EXPECT_EQ(parts().num_dofs_of_all(), one().num_dofs());
  const State start = parts().whole(parts_.initial);
  expect_same(start.q, one_.initial.q);
  expect_same(start.v, one_.initial.v);
  EXPECT_NEAR(parts().parts().mass->total(), one().parts().mass->total(), 1e-12 * one().parts().mass->total());
}

// Checks that the scenes test what they should: with few elements some of seven ranks have none, and the partition cuts
// through contact areas and supports.
TEST_P(SharedModel, IsDividedAsItsNameTells) {
  const Ranks& ranks = parts().parts().subdomain->ranks();
  const auto& subdomain = *parts().parts().subdomain;
  if (GetParam().name == "small" && ranks.size() == 7) {
    EXPECT_TRUE(ranks.any(subdomain.cells().empty()));
  }
  if (GetParam().name == "touching") {
    const State state = some_state();
    const NodalExpansion nodal(one().parts(), state.t, state.q, state.v);
    double touching = 0;
    for (int node = 0; node < static_cast<int>(one().parts().mesh.nodes.size()); ++node)
      if (subdomain.owns(node) && nodal.state().x(2, node) < -0.005) touching = 1;
    EXPECT_GE(ranks.sum(touching), std::min(ranks.size(), 2));
  }
  if (GetParam().name != "moved" && GetParam().name != "tied") return;
  const double has_held_ones = parts().num_dofs() < 3 * subdomain.num_owned() ? 1 : 0;
  if (ranks.size() > 1) {
    EXPECT_GE(ranks.sum(has_held_ones), 2);
  }
}

TEST_P(SharedModel, HasTheSameForce) {
  const State state = some_state(), part = parts().part(state);
  Vector f(one().num_dofs()), f_part(parts().num_dofs());
  one().force(state.t, state.q, state.v, f);
  parts().force(part.t, part.q, part.v, f_part);
  expect_same(whole(f_part), f);
}

TEST_P(SharedModel, HasTheSameMatrices) {
  const State state = some_state(), part = parts().part(state);
  for (const TangentKind kind : {TangentKind::exact, TangentKind::gauss_newton}) {
    Linearization at, at_part;
    one().linearize(state.t, state.q, state.v, kind, at);
    parts().linearize(part.t, part.q, part.v, kind, at_part);
    for (const Weights& w : {Weights{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1e-2, 1e-4}}) {
      std::vector<double> A(one().pattern().row.size()), A_part(parts().pattern().row.size());
      one().combine(w, at, A.data());
      parts().combine(w, at_part, A_part.data());
      Vector y(one().num_dofs()), y_part(parts().num_dofs());
      one().multiply_matrix(A.data(), state.v, y);
      parts().multiply_matrix(A_part.data(), part.v, y_part);
      expect_same(whole(y_part), y);
    }
  }
}

TEST_P(SharedModel, HasTheSameMass) {
  const State state = some_state(), part = parts().part(state);
  Vector y(one().num_dofs()), y_part(parts().num_dofs());
  one().multiply_mass(state.q, y);
  parts().multiply_mass(part.q, y_part);
  expect_same(whole(y_part), y);
  one().solve_mass(y);
  parts().solve_mass(y_part);
  expect_same(whole(y_part), y);
}

TEST_P(SharedModel, HasTheSameBoundOfFrequencies) {
  EXPECT_NEAR(parts().frequency_bound(), one().frequency_bound(), 1e-12 * one().frequency_bound());
  ASSERT_EQ(parts().force_parts(), one().force_parts());
  for (const auto& part : one().force_parts()) {
    const double bound = one().only({part})->frequency_bound();
    EXPECT_NEAR(parts().only({part})->frequency_bound(), bound, 1e-12 * bound) << part;
  }
}

TEST_P(SharedModel, SolvesItsMatrix) {
  const State state = some_state(), part = parts().part(state);
  Linearization at;
  parts().linearize(part.t, part.q, part.v, TangentKind::gauss_newton, at);
  std::vector<double> A(parts().pattern().row.size());
  parts().combine({1, 1e-2, 1e-4}, at, A.data());
  Vector b(parts().num_dofs()), x(parts().num_dofs());
  parts().multiply_matrix(A.data(), part.v, b);
  for (const char* name : {"auto", "petsc", "cholesky", "cholmod", "eigen_ldlt", "klu"}) {
    if (!solver_registry().at(name).unavailable.empty()) continue;
    const auto solver = make_linear_solver(name, parts().pattern());
    solver->set_tolerance({1e-10, 0});
    for (int time = 0; time < 2; ++time) {
      ASSERT_EQ(solver->factor(A.data()), FactorStatus::ok) << name;
      x.setZero();
      solver->solve(b, x);
      const double error = (whole(x) - state.v).norm() / state.v.norm();
      EXPECT_LE(error, solver->is_iterative() ? 1e-7 : 1e-10) << name;
    }
  }
}

TEST_P(SharedModel, IsToldWhereItsMatrixIsIndefinite) {
  const State state = some_state(), part = parts().part(state);
  Linearization at;
  parts().linearize(part.t, part.q, part.v, TangentKind::gauss_newton, at);
  std::vector<double> A(parts().pattern().row.size());
  parts().combine({-1, 0, 1e-9}, at, A.data());
  const auto solver = make_linear_solver("cholesky", parts().pattern());
  EXPECT_TRUE(solver->checks_definiteness());
  EXPECT_EQ(solver->factor(A.data()), FactorStatus::not_positive_definite);
  parts().combine({1, 0, 0}, at, A.data());
  EXPECT_EQ(solver->factor(A.data()), FactorStatus::ok);
}

TEST_P(SharedModel, MultigridWithRigidMotionsSolvesIt) {
  if (!mpi_world()) GTEST_SKIP() << "the solver's own tests have it";
  if (mpi_world()->any(parts().num_dofs() < 100)) {  // GAMG would not terminate with so few unknowns
    EXPECT_THROW(make_linear_solver({"petsc", "-pc_type gamg"}, parts().pattern()), ConfigError);
    return;
  }
  const State state = some_state(), part = parts().part(state);
  Linearization at;
  parts().linearize(part.t, part.q, part.v, TangentKind::gauss_newton, at);
  std::vector<double> A(parts().pattern().row.size());
  parts().combine({1, 1e-1, 1e-2}, at, A.data());
  Vector b(parts().num_dofs()), x(parts().num_dofs());
  parts().multiply_matrix(A.data(), part.v, b);
  const auto solver = make_linear_solver({"petsc", "-ksp_type cg -pc_type gamg -pc_gamg_agg_nsmooths 0"});
  solver->analyze(parts().pattern());
  solver->set_tolerance({1e-10, 0});
  ASSERT_TRUE(solver->wants_rigid_motions());
  solver->set_rigid_motions(parts().rigid_motions(part.q));
  ASSERT_EQ(solver->factor(A.data()), FactorStatus::ok);
  solver->solve(b, x);
  EXPECT_LE((whole(x) - state.v).norm(), 1e-8 * state.v.norm());
}

// Only one rank owns the singular diagonal block, but all ranks must return the status.
TEST_P(SharedModel, IsToldWhereItsMatrixIsSingular) {
  const State state = some_state(), part = parts().part(state);
  Linearization at;
  parts().linearize(part.t, part.q, part.v, TangentKind::gauss_newton, at);
  const Pattern& pattern = parts().pattern();
  const int owned = pattern.share ? pattern.share->owned : pattern.n;
  const auto row_of = [&](int i) { return pattern.share ? pattern.share->row[static_cast<std::size_t>(i)] : i; };
  // The first pair of successive unknowns, over all ranks, that are coordinates of one point.
  double first = std::numeric_limits<double>::infinity();
  for (int i = owned - 2; i >= 0; --i)
    if (pattern.coordinate[static_cast<std::size_t>(i) + 1] % 3 != 0 &&
        pattern.coordinate[static_cast<std::size_t>(i) + 1] == pattern.coordinate[static_cast<std::size_t>(i)] + 1)
      first = static_cast<double>(row_of(i));
  if (mpi_world()) first = -mpi_world()->max(-first);
  const auto is_one = [&](int i) { return row_of(i) == first || row_of(i) == first + 1; };

  std::vector<double> A(pattern.row.size());
  parts().combine({1, 0, 0}, at, A.data());
  const auto solver = make_linear_solver({"petsc"}, pattern);
  ASSERT_EQ(solver->factor(A.data()), FactorStatus::ok);
  for (int j = 0; j < pattern.n; ++j)
    for (int k = pattern.column_start[static_cast<std::size_t>(j)];
         k < pattern.column_start[static_cast<std::size_t>(j) + 1]; ++k)
      if (is_one(j) && is_one(pattern.row[static_cast<std::size_t>(k)]))
        A[static_cast<std::size_t>(k)] = j < owned ? 1e-3 : 0;  // makes the two rows equal, summed over all ranks
  EXPECT_EQ(solver->factor(A.data()), FactorStatus::singular);
}

TEST_P(SharedModel, TellsTheSameOfAState) {
  const State state = some_state(), part = parts().part(state);
  int compared = 0;
  for (const OutputInfo& info : parts().outputs()) {
    const auto found = parts().evaluate(info.name, part), expected = one().evaluate(info.name, state);
    ASSERT_EQ(found.size(), expected.size()) << info.name;
    double size = 0;
    for (const double x : expected)
      if (!std::isnan(x)) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(std::isnan(found[i]), std::isnan(expected[i])) << info.name << " " << i;
      if (!std::isnan(found[i])) {
        ASSERT_NEAR(found[i], expected[i], 1e-10 * size) << info.name << " " << i;
      }
    }
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

TEST_P(SharedModel, WhatOneRankCannotEvaluateIsToldToAll) {
  if (!mpi_world()) GTEST_SKIP() << "there is nobody to tell";
  State part = parts().part(some_state());
  // Only the rank that owns the first unknown gets an invalid state.
  const bool has_first = !parts().parts().unknowns.empty() && parts().parts().unknowns[0] == 0;
  if (has_first) part.q[0] = std::numeric_limits<double>::quiet_NaN();
  Vector f(parts().num_dofs());
  EXPECT_THROW(parts().force(0, part.q, part.v, f), RecoverableError);
  Linearization at;
  EXPECT_THROW(parts().linearize(0, part.q, part.v, TangentKind::exact, at), RecoverableError);
  const auto all = parts().only(parts().force_parts());
  EXPECT_THROW(all->linearize(0, part.q, part.v, TangentKind::exact, at), RecoverableError);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedModel, testing::ValuesIn(shared_scenes()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace orthodyn
