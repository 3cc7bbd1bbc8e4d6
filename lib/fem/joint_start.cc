#include "lib/fem/joint_start.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/fem/fem_model.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn {

namespace {

// The joint that has this constraint.
const Joint& joint_of(const FemModel::Parts& parts, int constraint) {
  int first = 0;
  for (const Joint& joint : parts.joints)
    for (const JointEquation& equation : joint.equations)
      if (first += equation.size(); constraint < first) return joint;
  throw std::logic_error("no such constraint");
}

// Refuses a start in which the coordinate of a joint differs from the value that its motor prescribes.
void require_motors_at_start(const FemModel& model, const State& state) {
  constexpr double kApart = 1e-9;
  const NodalExpansion nodal(model.parts(), state.t, state.q, state.v);
  for (const Joint& joint : model.parts().joints) {
    const JointEquation* driven = joint.motor();
    if (!driven) continue;
    const double found = joint.coordinate->value(nodal.u), wanted = driven->motor.value(state.t);
    const bool is_angle = joint.coordinate->is_angle();
    const double apart = is_angle ? std::remainder(wanted - found, 2 * std::acos(-1.0)) : wanted - found;
    const double scale = is_angle ? 1 : driven->length();
    if (!(std::abs(apart) <= kApart * scale))
      throw ConfigError(joint.place, fmt::format("motor: `to` times `factor` is {0:.4g} {2} at the start, where the "
                                                 "coordinate is {1:.4g} {2}; let the factor begin there",
                                                 wanted, found, joint.coordinate->unit()));
  }
}

// State::angles at the start: between -pi and pi, or with the turns that a motor prescribes.
Vector angles_at_start(const FemModel& model, const State& state) {
  Vector angles = model.angles(state).values;
  Eigen::Index i = 0;
  for (const Joint& joint : model.parts().joints) {
    if (!joint.turn()) continue;
    if (const JointEquation* driven = joint.motor(); driven && joint.coordinate->is_angle())
      angles.segment(i, 1) = nearest_turns(angles.segment(i, 1), Vector::Constant(1, driven->motor.value(state.t)));
    ++i;
  }
  return angles;
}

// The sum of constraints that changes least with the motion, with coefficients for constraints of equal size.
struct WeakestSum {
  double eigenvalue;    // of the scaled matrix of the constraints: 1 if they are independent, 0 if they are dependent
  Vector coefficients;  // of the constraints
  Vector shares;        // of the constraints, scaled: at most 1
  int dependent;        // number of independent sums of constraints that no motion changes
};

constexpr double kDependent = 1e-10;  // eigenvalue

WeakestSum weakest_sum(const ConstraintsAt& at) {
  const Eigen::MatrixXd& H = at.matrix();
  const Vector scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H * scale.asDiagonal());
  const Vector weakest = eigen.eigenvectors().col(0);
  return {eigen.eigenvalues()[0], scale.cwiseProduct(weakest), weakest.cwiseAbs(),
          static_cast<int>((eigen.eigenvalues().array() < kDependent).count())};
}

// The joints of bodies with a noticeable share in a sum of constraints.
std::vector<std::string> joints_of(const FemModel& model, const Vector& shares) {
  constexpr double kNoticeable = 0.05;
  std::vector<std::string> names;
  for (int k = 0; k < static_cast<int>(shares.size()); ++k) {
    const Joint& joint = joint_of(model.parts(), k);
    if (joint.of == Joint::Of::bodies && shares[k] > kNoticeable * shares.maxCoeff() &&
        (names.empty() || names.back() != joint.name))
      names.push_back(joint.name);
  }
  return names;
}

// Refuses constraints of which a sum does not change with any motion.
void require_independent(const FemModel& model, const State& state, const WeakestSum& sum) {
  constexpr double kContradicts = 1e-6;
  if (sum.eigenvalue >= kDependent) return;
  const Constraints& constraints = *model.constraints();
  Vector shares = sum.shares;
  for (int k = 0; k < constraints.size(); ++k)  // joints are what a user can remove
    if (joint_of(model.parts(), k).of == Joint::Of::rigid_body) shares[k] = 0;
  Eigen::Index worst = 0;
  shares.maxCoeff(&worst);
  const Joint& joint = joint_of(model.parts(), static_cast<int>(worst));
  std::vector<std::string> others = joints_of(model, shares);
  std::erase(others, joint.name);
  const std::string by = others.empty()       ? "clamps and its other constraints"
                         : others.size() == 1 ? "the joint " + others[0]
                                              : "the joints " + join(others);
  const Vector still = Vector::Zero(state.q.size());
  Vector rates(constraints.size()), curvatures(constraints.size());  // by motors and supports
  constraints.rates(state.t, state.q, still, rates);
  constraints.curvature(state.t, state.q, still, curvatures);
  const auto is_driven = [&](const Vector& by_time) {
    return std::abs(sum.coefficients.dot(by_time)) > kContradicts * sum.coefficients.cwiseAbs().dot(by_time.cwiseAbs());
  };
  if (is_driven(rates) || is_driven(curvatures))
    throw ConfigError(joint.place, fmt::format("{} contradicts {}: its motor prescribes another motion than they "
                                               "allow; remove a motor or a joint",
                                               constraints.name(static_cast<int>(worst)), by));
  throw ConfigError(
      joint.place,
      fmt::format("{} is already held by {} in the rest shape, {} too many: remove a joint, replace hinges (hinge, "
                  "hinge, ball and cylindrical hold a plane four-bar without repetition), give each joint of a "
                  "deformable body nodes of its own, or draw links that are in line there in another position",
                  constraints.name(static_cast<int>(worst)), by,
                  sum.dependent == 1 ? "1 constraint" : fmt::format("{} constraints", sum.dependent)));
}

}  // namespace

double start_consistently(const FemModel& model, State& state) {
  const Constraints* constraints = model.constraints();
  if (!constraints) return 0;
  require_motors_at_start(model, state);
  constexpr double kApart = 1e-9;  // relative to the body
  const auto fail = [&](Eigen::Index constraint, const std::string& what) {
    const int k = static_cast<int>(constraint);
    throw ConfigError(joint_of(model.parts(), k).place, fmt::format("{} {}", constraints->name(k), what));
  };
  const int m = constraints->size();
  Vector g(m);
  constraints->values(state.t, state.q, g);
  Eigen::Index worst = 0;
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  if (const double apart = g.cwiseAbs().maxCoeff(&worst); apart > kApart * extent)
    fail(worst, fmt::format("{} {:.3g} m apart at the start; the initial displacement must {}",
                            joint_of(model.parts(), static_cast<int>(worst)).of == Joint::Of::rigid_body
                                ? "has nodes whose distances change by up to"
                                : "has points",
                            apart,
                            joint_of(model.parts(), static_cast<int>(worst)).of == Joint::Of::rigid_body
                                ? "not deform rigid regions"
                                : "keep joints together"));
  const ConstraintsAt at(model, state.t, state.q);
  for (Eigen::Index k = 0; k < m; ++k)
    if (!(at.matrix()(k, k) > 0))
      fail(k, "holds nothing that can move: all its nodes are clamped or moved, or belong to one rigid body");
  require_independent(model, state, weakest_sum(at));
  const Vector before = state.v;
  at.fit(state.v);
  Vector a(state.q.size());
  if (const InternalVariables* internal = model.internal_variables(); internal && state.z.size() > 0)
    internal->force(state.t, state.q, state.v, {InternalState::Kind::given, state.z.data(), 0}, a);
  else model.force(state.t, state.q, state.v, a);
  model.solve_mass(a);
  state.lambda = at.multipliers(state.v, a);
  state.angles = angles_at_start(model, state);
  return (state.v - before).lpNorm<Eigen::Infinity>();
}

std::vector<std::string> joints_at_their_end(const FemModel& model, const State& state) {
  constexpr double kNearlyDependent = 1e-5;  // beside 1e-10 at the start, as the last state is some steps away
  if (!model.constraints()) return {};
  const WeakestSum sum = weakest_sum(ConstraintsAt(model, state.t, state.q));
  if (!(sum.eigenvalue < kNearlyDependent)) return {};
  return joints_of(model, sum.shares);
}

}  // namespace orthodyn
