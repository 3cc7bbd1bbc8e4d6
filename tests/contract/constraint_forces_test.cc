// Accelerations and multipliers at one state after another.
#include "integrators/sundials/constraint_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/ode/constraints_at.h"
#include "tests/contract/models.h"

namespace orthodyn::constraint_forces_test {
namespace {

// Beads in the plane on a string from the origin, at distances of 1, with a mass matrix that is not diagonal.
class Necklace : public SmallModel, public Constraints {
 public:
  static constexpr int kBeads = 10;
  Necklace() : SmallModel(mass()) {}
  const Constraints* constraints() const override { return this; }
  int size() const override { return kBeads; }
  std::string name(int) const override { return "string"; }
  Vector piece(const ConstVectorRef& q, int i) const {
    return i == 0 ? Vector(q.segment(0, 2)) : Vector(q.segment(2 * i, 2) - q.segment(2 * i - 2, 2));
  }
  void values(double, const ConstVectorRef& q, VectorRef g) const override {
    for (int i = 0; i < kBeads; ++i) g[i] = (piece(q, i).squaredNorm() - 1) / 2;
  }
  Eigen::SparseMatrix<double> jacobian(double, const ConstVectorRef& q) const override {
    Eigen::SparseMatrix<double> G(2 * kBeads, kBeads);
    for (int i = 0; i < kBeads; ++i)
      for (int k = 0; k < 2; ++k) {
        G.insert(2 * i + k, i) = piece(q, i)[k];
        if (i > 0) G.insert(2 * i - 2 + k, i) = -piece(q, i)[k];
      }
    return G;
  }
  void rates(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const override {
    for (int i = 0; i < kBeads; ++i) g_rate[i] = piece(q, i).dot(piece(v, i));
  }
  void curvature(double, const ConstVectorRef&, const ConstVectorRef& v, VectorRef c) const override {
    for (int i = 0; i < kBeads; ++i) c[i] = piece(v, i).squaredNorm();
  }
  void force(double, const ConstVectorRef&, const ConstVectorRef&, VectorRef f) const override { f.setOnes(); }
  void solve_mass(VectorRef x) const override {
    ++solves;
    SmallModel::solve_mass(x);
  }
  State initial() const override { return at(0); }
  double end() const override { return 1; }
  // A string that bends more with `bend`.
  State at(double bend) const {
    State s{0, Vector(2 * kBeads), Vector(2 * kBeads)};
    Vector place = Vector::Zero(2);
    for (int i = 0; i < kBeads; ++i) {
      place += Vector{{std::cos(0.3 + bend * i), std::sin(0.3 + bend * i)}};
      s.q.segment(2 * i, 2) = place;
      s.v.segment(2 * i, 2) = Vector{{std::sin(i), std::cos(2.0 * i)}};
    }
    return s;
  }

  mutable int solves = 0;

 private:
  static Matrix mass() {
    Matrix M = 4 * Matrix::Identity(2 * kBeads, 2 * kBeads);
    for (int i = 2; i < 2 * kBeads; ++i) M(i, i - 2) = M(i - 2, i) = 1;
    return M;
  }
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override {
    return Matrix::Zero(2 * kBeads, 2 * kBeads);
  }
};

TEST(ConstraintForces, AreThoseOfADirectSolution) {
  const Necklace model;
  sundials::ConstraintForces forces(model);
  for (const double bend : {0.1, 0.1001, 0.102, 0.1, 0.5, 0.501, -0.4}) {
    const State s = model.at(bend);
    Vector a = Vector::LinSpaced(2 * Necklace::kBeads, -1, 2), exact_a = a;
    const Vector exact = ConstraintsAt(model, 0, s.q).multipliers(s.v, exact_a);
    const Vector lambda = forces.multipliers(0, s.q, s.v, a);
    EXPECT_LE((lambda - exact).norm(), 1e-10 * exact.norm()) << bend;
    EXPECT_LE((a - exact_a).norm(), 1e-10 * exact_a.norm()) << bend;
  }
}

TEST(ConstraintForces, TakeFewSolvesNearAnEarlierState) {
  const Necklace model;
  sundials::ConstraintForces forces(model);
  const auto solves = [&](double bend) {
    const State s = model.at(bend);
    Vector a = Vector::Ones(2 * Necklace::kBeads);
    model.solves = 0;
    forces.multipliers(0, s.q, s.v, a);
    return model.solves;
  };
  EXPECT_EQ(solves(0.1), Necklace::kBeads);
  EXPECT_EQ(solves(0.1), 1);
  EXPECT_LE(solves(0.10001), 4);
}

}  // namespace
}  // namespace orthodyn::constraint_forces_test
