// The laws of fibres at a point: derivatives, conservation, invariance, and limits.
#include "lib/fem/added_laws/fibres.h"

#include <gtest/gtest.h>

#include <functional>

#include "lib/core/errors.h"
#include "lib/fem/time_functions/time_function.h"
#include "tests/fem/derivatives.h"
#include "tests/material/constants.h"

namespace orthodyn::fibres_test {
namespace {

using BatchMat = Mat3T<Batch>;

BatchMat batch(const Mat3& m) { return m.cast<Batch>(); }
Mat3 first_lane(const BatchMat& m) {
  return m.unaryExpr([](const Batch& x) { return x[0]; });
}

const std::string kExponential = "passive: {type: exponential, k1: 40, k2: 3}";
const std::string kCurve = "passive: {type: curve, points: [[1.02, 1], [1.2, 60], [1.6, 500]]}";
const std::string kIsometric = "active: {stress: 100, length: {type: gaussian, optimal_stretch: 1.05, width: 0.5}}";
const std::string kTable =
    "active: {stress: 100, length: {type: table, points: [[0.4, 0], [0.9, 0.9], [1.1, 1], [1.7, 0]]}}";
const std::string kHill = "active: {stress: 100, velocity: {type: hill, shortening_velocity: 5}}";

// The law of the text at t = 0.3. Active laws have the activation 0.7 there, which rises by 2 per second.
class Law {
 private:
  static constexpr double kTime = 0.3;

  template <class Function>
  auto on(const Mat3& H, const Mat3& Q, Function&& f, double t = kTime) const {
    const BatchMat h = batch(H), q = batch(Q);
    return f(*law_->at(t), LawPoint{0, h, q});
  }

 public:
  explicit Law(const std::string& yaml, Kinematics kinematics = Kinematics::corotational) {
    const Fibres fibres = Fibres::spec().read(Config::from_text(yaml).resolving());
    if (fibres.passive) law_ = make_passive_fibres(*fibres.passive, kinematics);
    else
      law_ = make_active_fibres(
          *fibres.active, kinematics,
          {scaled_values(Vector::Ones(Batch::kLanes),
                         Registry<TimeFunction>::read(
                             Config::from_text("{type: table, points: [[0, 0.1], [0.4, 0.9]]}").resolving()),
                         1),
           1, [](double, double, Eigen::Index) { throw ConfigError("refused"); }});
  }

  const AddedLaw& law() const { return *law_; }
  Mat3 stress(const Mat3& H, const Mat3& Q, const Mat3* rate = nullptr) const {
    return on(H, Q, [&](const AddedLawAt& law, const LawPoint& at) {
      if (!rate) return first_lane(law.stress(at, nullptr));
      const BatchMat all = batch(*rate);
      return first_lane(law.stress(at, &all));
    });
  }
  double energy(const Mat3& H, const Mat3& Q, double t = kTime) const {
    return on(
        H, Q, [](const AddedLawAt& law, const LawPoint& at) { return law.energy(at)[0]; }, t);
  }
  double power(const Mat3& H, const Mat3& Q, const Mat3& rate) const {
    return on(H, Q, [&](const AddedLawAt& law, const LawPoint& at) { return law.power(at, batch(rate))[0]; });
  }
  double dissipation(const Mat3& H, const Mat3& Q, const Mat3& rate) const {
    return on(H, Q, [&](const AddedLawAt& law, const LawPoint& at) { return law.dissipation(at, batch(rate))[0]; });
  }
  struct Moduli {
    Eigen::Matrix<double, 9, 9> K, D;
  };
  Moduli moduli(const Mat3& H, const Mat3& Q, const Mat3* rate = nullptr, TangentKind kind = TangentKind::exact) const {
    return on(H, Q, [&](const AddedLawAt& law, const LawPoint& at) {
      Mat9T<Batch> K = Mat9T<Batch>::Zero(), D = K;
      const BatchMat all = rate ? batch(*rate) : BatchMat();
      law.add_moduli(at, rate ? &all : nullptr, kind, K, &D);
      const auto lane = [](const Mat9T<Batch>& m) {
        return Eigen::Matrix<double, 9, 9>(m.unaryExpr([](const Batch& x) { return x[0]; }));
      };
      return Moduli{lane(K), lane(D)};
    });
  }
  Mat3 mean_stress(const Mat3& H0, const Mat3& H1, const Mat3& Q) const {
    const BatchMat h1 = batch(H1);
    return on(H0, Q, [&](const AddedLawAt& law, const LawPoint& at0) {
      return first_lane(law.mean_stress(at0, {0, h1, at0.Q}));
    });
  }

 private:
  std::unique_ptr<AddedLaw> law_;
};

std::vector<std::string> all_laws() { return {kExponential, kCurve, kIsometric, kTable, kHill}; }

// H Q of a deformation with this stretch of the fibre, turned and sheared at random.
Mat3 state(Random& random, const Mat3& Q, double stretch) {
  Mat3 F = random.rotation() * (Mat3::Identity() + 0.3 * random.matrix());
  F *= stretch / (F * Q).col(0).norm();
  return F * Q - Q;
}

// expect_derivative(), or no change where the derivative is zero, as of a fibre in compression.
template <class F>
void expect_slope(const F& f, const Vector& expected) {
  if (expected.norm() > 0) expect_derivative(f, expected);
  else EXPECT_EQ((f(kStep) - f(-kStep)).norm(), 0);
}

Vector flat(const Mat3& m) { return m.reshaped(); }

// Calls visit(law, Q, H) for all laws, kinematics and stretches away from kinks.
void for_each_state(const std::function<void(const Law&, const Mat3& Q, const Mat3& H, Random&)>& visit) {
  Random random(11);
  for (const auto& yaml : all_laws())
    for (const Kinematics kinematics : {Kinematics::corotational, Kinematics::linear})
      for (const double stretch : {0.8, 1.3}) {
        SCOPED_TRACE(yaml + (kinematics == Kinematics::linear ? ", linear" : "") + " at " + std::to_string(stretch));
        const Law law(yaml, kinematics);
        const Mat3 Q = random.rotation();
        Mat3 H = state(random, Q, stretch);
        if (kinematics == Kinematics::linear) H.col(0) = (stretch - 1) * Q.col(0) + 0.1 * Q.col(1);
        visit(law, Q, H, random);
      }
}

TEST(FibreLaws, TheStressIsTheDerivativeOfTheEnergy) {
  for_each_state([](const Law& law, const Mat3& Q, const Mat3& H, Random& random) {
    const Mat3 dH = random.matrix();
    expect_slope([&](double h) { return one(law.energy(H + h * dH, Q)); },
                 one(law.stress(H, Q).cwiseProduct(dH).sum()));
  });
}

TEST(FibreLaws, TheModuliAreTheDerivativeOfTheStress) {
  for_each_state([](const Law& law, const Mat3& Q, const Mat3& H, Random& random) {
    const Mat3 dH = random.matrix();
    const auto moduli = law.moduli(H, Q);
    EXPECT_EQ((moduli.K - moduli.K.transpose()).norm(), 0);
    expect_slope([&](double h) { return flat(law.stress(H + h * dH, Q)); }, moduli.K * flat(dH));
  });
}

// While the body moves, the moduli are the symmetric part, which has the same quadratic form.
TEST(FibreLaws, TheModuliOfAMovingBodyAreTheSymmetricPartOfTheDerivative) {
  for_each_state([](const Law& law, const Mat3& Q, const Mat3& H, Random& random) {
    const Mat3 dH = random.matrix(), rate = 3 * random.matrix();
    const auto moduli = law.moduli(H, Q, &rate);
    expect_slope([&](double h) { return one(law.stress(H + h * dH, Q, &rate).cwiseProduct(dH).sum()); },
                 one(flat(dH).dot(moduli.K * flat(dH))));
    expect_slope(
        [&](double h) {
          const Mat3 changed = rate + h * dH;
          return flat(law.stress(H, Q, &changed));
        },
        moduli.D * flat(dH));
  });
}

TEST(FibreLaws, GaussNewtonModuliArePositiveSemidefinite) {
  Random random(3);
  for (const auto& yaml : all_laws())
    for (const double stretch : {0.6, 0.9, 1.2, 1.5}) {
      const Law law(yaml);
      const Mat3 Q = random.rotation(), rate = 3 * random.matrix();
      const auto K = law.moduli(state(random, Q, stretch), Q, &rate, TangentKind::gauss_newton).K;
      const Vector values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
      EXPECT_GE(values[0], -1e-14 * (1 + values[8])) << yaml << stretch;
    }
}

TEST(FibreLaws, TurnWithTheBody) {
  Random random(5);
  for (const auto& yaml : all_laws()) {
    const Law law(yaml);
    const Mat3 Q = random.rotation(), R = random.rotation(), H = state(random, Q, 1.2), F = Q + H;
    const Mat3 rate = random.matrix();
    const Vec3 w = 4 * random.vector();
    Mat3 spin;
    spin << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    const Mat3 turned_rate = R * rate + spin * R * F, P = law.stress(H, Q, &rate);
    EXPECT_LE((law.stress(R * F - Q, Q, &turned_rate) - R * P).norm(), 1e-13 * P.norm()) << yaml;
    EXPECT_NEAR(law.energy(R * F - Q, Q), law.energy(H, Q), 1e-13 * law.energy(H, Q)) << yaml;
    const Mat3 torque = P * F.transpose();
    EXPECT_LE((torque - torque.transpose()).norm(), 1e-13 * torque.norm()) << yaml;
  }
}

TEST(FibreLaws, TheMeanStressDoesTheWorkOfTheEnergyWithoutATorque) {
  for_each_state([](const Law& law, const Mat3& Q, const Mat3& H0, Random& random) {
    for (const double size : {1.0, 0.1, 1e-4, 1e-8}) {
      const Mat3 H1 = H0 + size * random.matrix(), P = law.mean_stress(H0, H1, Q);
      const double before = law.energy(H0, Q), after = law.energy(H1, Q);
      EXPECT_NEAR(P.cwiseProduct(H1 - H0).sum(), after - before, 1e-14 * (before + after + P.norm()));
      EXPECT_LE((P - law.stress(0.5 * (H0 + H1), Q)).norm(), (30 * size * size + 1e-13) * (P.norm() + 100));
    }
  });
  Random random(6);
  const Mat3 Q = random.rotation(), H0 = state(random, Q, 1.2), H1 = state(random, Q, 0.7);
  for (const auto& yaml : all_laws()) {
    const Mat3 torque = Law(yaml).mean_stress(H0, H1, Q) * (2 * Q + H0 + H1).transpose();
    EXPECT_LE((torque - torque.transpose()).norm(), 1e-13 * (torque.norm() + 1)) << yaml;
  }
}

// dE/dt = P : dF/dt - dissipation + supply, with the work P : dF/dt done on the fibre.
TEST(FibreLaws, TheEnergyIsBalanced) {
  for_each_state([](const Law& law, const Mat3& Q, const Mat3& H, Random& random) {
    const Mat3 rate = 3 * random.matrix();
    const double work = law.stress(H, Q, &rate).cwiseProduct(rate).sum();
    const double change = work - law.dissipation(H, Q, rate) + law.power(H, Q, rate);
    expect_slope([&](double h) { return one(law.energy(H + h * rate, Q, 0.3 + h)); }, one(change));
    EXPECT_GE(law.dissipation(H, Q, rate), 0);
    EXPECT_EQ(law.dissipation(H, Q, rate) > 0, law.law().depends_on_rate());
  });
}

TEST(FibreLaws, LinearKinematicsAgreeForSmallStrains) {
  Random random(8);
  for (const auto& yaml : all_laws()) {
    const Law linear(yaml, Kinematics::linear), exact(yaml);
    const Mat3 Q = random.rotation(), shape = random.matrix();
    const auto difference = [&](double h) { return (linear.stress(h * shape, Q) - exact.stress(h * shape, Q)).norm(); };
    EXPECT_LE(difference(1e-5), 1e-3 * exact.stress(1e-5 * Q, Q).norm()) << yaml;  // the direction turns by 1e-5
    const auto twin = linear.law().corotational();
    EXPECT_EQ(twin->description(), exact.law().description());
  }
}

TEST(FibreLaws, KeepTheDigitsOfSmallStrains) {
  const Mat3 Q = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const double strain = 1e-12;
  const Mat3 P = Law(kExponential).stress(strain * Q, Q);
  EXPECT_NEAR(P.col(0).norm(), 4 * 40 * strain, 1e-10 * 4 * 40 * strain);
}

TEST(FibreLaws, RefuseAFibreWithoutLengthAndAnInfiniteStress) {
  const Mat3 Q = Mat3::Identity();
  EXPECT_THROW(Law(kIsometric).stress(-Q, Q), RecoverableError);
  EXPECT_THROW(Law(kExponential).stress(100 * Q, Q), RecoverableError);
  EXPECT_THROW(Law(kExponential).stress(std::nan("") * Q, Q), RecoverableError);
  EXPECT_NO_THROW(Law(kIsometric, Kinematics::linear).stress(-Q, Q));
}

TEST(FibreLaws, RefuseActivationsOutsideOfZeroAndOne) {
  const Fibres fibres = Fibres::spec().read(Config::from_text(kIsometric).resolving());
  Vector values = Vector::Constant(Batch::kLanes + 1, 0.5);
  values[Batch::kLanes] = 1.1;
  const auto factor = Registry<TimeFunction>::read(Config::from_text("{type: ramp, end: 1}").resolving());
  Eigen::Index element = -1;
  const auto law =
      make_active_fibres(*fibres.active, Kinematics::corotational,
                         {scaled_values(values, factor, 1), 1, [&](double t, double value, Eigen::Index e) {
                            element = e;
                            throw ConfigError(std::to_string(t) + " " + std::to_string(value));
                          }});
  EXPECT_NO_THROW(law->at(0.9));
  EXPECT_THROW(law->at(0.95), ConfigError);
  EXPECT_EQ(element, Batch::kLanes);
}

}  // namespace
}  // namespace orthodyn::fibres_test
