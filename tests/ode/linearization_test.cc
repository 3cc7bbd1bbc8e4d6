// The conditions under which a Linearization is reused or assembled again.
#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "lib/ode/model.h"

namespace orthodyn::linearization_test {
namespace {

// The oscillator q'' = -k q - d q' (primes: time derivatives). Counts its assemblies.
class Oscillator : public Model {
 public:
  Oscillator(double k, double d, bool linear) : k_(k), d_(d) {
    pattern_.n = 1;
    pattern_.column_start = {0, 1};
    pattern_.row = {0};
    traits_.linear = linear;
  }

  int num_dofs() const override { return 1; }
  const Traits& traits() const override { return traits_; }
  const Pattern& pattern() const override { return pattern_; }
  void force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    f = -k_ * q - d_ * v;
  }
  void combine(const Weights&, const Linearization&, double*) const override {}
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { y = x; }
  void solve_mass(VectorRef) const override {}

  // K and D; D = 0 if there is no damping.
  std::pair<double, double> matrices(Linearization& at) const {
    linearize(0, Vector::Zero(1), Vector::Zero(1), TangentKind::exact, at);
    return {at.stiffness[0], at.damping.empty() ? 0 : at.damping[0]};
  }

  mutable int assemblies = 0;
  bool refuses = false;

 private:
  void assemble(double, const ConstVectorRef&, const ConstVectorRef&, TangentKind, Linearization& out) const override {
    ++assemblies;
    out.stiffness.assign(1, 0);
    if (refuses) throw RecoverableError("not here");
    out.stiffness[0] = k_;
    if (d_ > 0) out.damping.assign(1, d_);
  }

  double k_, d_;
  Pattern pattern_;
  Traits traits_;
};

TEST(Linearization, OfALinearModelIsAssembledOnce) {
  const Oscillator model(4, 0.5, true);
  Linearization at;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(model.matrices(at), std::pair(4.0, 0.5));
  EXPECT_EQ(model.assemblies, 1);
}

TEST(Linearization, OfANonlinearModelIsAssembledEachTime) {
  const Oscillator model(4, 0.5, false);
  Linearization at;
  for (int k = 0; k < 3; ++k) model.matrices(at);
  EXPECT_EQ(model.assemblies, 3);
}

TEST(Linearization, IsNotTakenForThatOfAnotherModelOfTheSameSize) {
  const Oscillator soft(4, 0.5, true), stiff(9, 0, true), varying(25, 0, false);
  Linearization at;
  EXPECT_EQ(soft.matrices(at), std::pair(4.0, 0.5));
  EXPECT_EQ(stiff.matrices(at), std::pair(9.0, 0.0));  // the damping of `soft` is removed
  EXPECT_EQ(soft.matrices(at), std::pair(4.0, 0.5));
  EXPECT_EQ(varying.matrices(at), std::pair(25.0, 0.0));
  EXPECT_EQ(soft.matrices(at), std::pair(4.0, 0.5));
}

TEST(Linearization, IsNotTakenForThatOfACopy) {
  const Oscillator model(4, 0, true);
  Linearization at;
  model.matrices(at);
  const Oscillator copy = model;  // NOLINT
  copy.matrices(at);
  EXPECT_EQ(copy.assemblies, 2);  // one of them before the copy
}

TEST(Linearization, ThatCouldNotBeAssembledIsTriedAgain) {
  Oscillator model(4, 0, true);
  model.refuses = true;
  Linearization at;
  EXPECT_THROW(model.matrices(at), RecoverableError);
  model.refuses = false;
  EXPECT_EQ(model.matrices(at), std::pair(4.0, 0.0));
}

}  // namespace
}  // namespace orthodyn::linearization_test
