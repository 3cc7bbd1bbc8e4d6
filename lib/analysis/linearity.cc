#include "lib/analysis/linearity.h"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "lib/fem/element_mesh.h"
#include "lib/fem/terms/added_term.h"

namespace orthodyn {

namespace {

constexpr double kNegligible = 1e-6;  // relative error that counts as zero; above round-off
constexpr double kUnknown = std::numeric_limits<double>::infinity();

double norm(const Vector& x, const Vector& Mx) { return std::sqrt(std::max(x.dot(Mx), 0.0)); }

// The elastic term and its added terms with corotational kinematics.
std::vector<std::unique_ptr<Term>> with_exact_force(const ElasticTerm& term, const ElementMesh& elements,
                                                    const BlockPattern& pattern) {
  ElasticRegion region = term.definition();
  region.options = {};
  std::vector<std::unique_ptr<Term>> all;
  all.push_back(term.type().elastic_term(elements, std::move(region), pattern));
  for (const AddedTerm* added : term.added()) all.push_back(added->corotational(elements, pattern));
  return all;
}

// The part of shift(mean + swing) that is odd in `swing`. If no shift is found for the full swing, smaller swings are
// tried, and the odd part is extrapolated as a cubic.
std::optional<Vector> odd_part(const std::function<std::optional<Vector>(const Vector&)>& shift, const Vector& mean,
                               const Vector& swing) {
  constexpr double kLeast = 0.1;  // smallest tried fraction of the swing
  for (double share = 1; share > kLeast; share /= 2) {
    const std::optional<Vector> to = shift(mean + share * swing);
    const std::optional<Vector> fro = to ? shift(mean - share * swing) : std::nullopt;
    if (to && fro) return Vector((*to - *fro) / (2 * share * share * share));
  }
  return std::nullopt;
}

}  // namespace

double VibrationDrift::after(double duration) const {
  const double x = decay * duration;
  return rate * duration * (x > 0 ? -std::expm1(-x) / x : 1);
}

Linearity::Linearity(const FemModel& model, Terms terms, double span)
    : model_(model),
      terms_(std::move(terms)),
      exact_(model.parts().elastic.size()),
      mass_(std::isfinite(span) ? 1 / (span * span) : 0) {
  const FemModel::Parts& parts = model_.parts();
  const ElementMesh elements(parts.mesh, &parts.dofs->ties());
  for (const std::size_t k : terms_) exact_[k] = with_exact_force(*parts.elastic[k], elements, *parts.pattern);
  solver_ = make_solver_for(model_.pattern());
  if (!factor(0, Vector::Zero(model_.num_dofs()), TangentKind::exact))
    throw RunError("the stiffness at rest is singular: the body is not held");
}

bool Linearity::factor(double t, const Vector& q, TangentKind kind) {
  model_.linearize(t, q, Vector::Zero(q.size()), kind, tangent_);
  values_.resize(tangent_.stiffness.size());
  model_.combine({mass_, 0, 1}, tangent_, values_.data());
  holds_rest_ = q.isZero(0);
  return solver_->factor(values_.data()) == FactorStatus::ok;
}

bool Linearity::factor_for(double t, const Vector& q) {
  if (model_.traits().linear) return holds_rest_ || factor(t, Vector::Zero(q.size()), TangentKind::exact);
  return factor(t, q, TangentKind::exact) || factor(t, q, TangentKind::gauss_newton);
}

bool Linearity::factor_exact(double t, const Vector& q, const Terms& terms) {
  const FemModel::Parts& parts = model_.parts();
  const Vector still = Vector::Zero(q.size());
  const NodalExpansion nodal(parts, t, q, still);
  std::vector<double> linear(values_.size());
  model_.linearize(t, q, still, TangentKind::exact, tangent_);
  model_.combine({mass_, 0, 1}, tangent_, values_.data());
  add_tangents(true, terms, nodal.state(), values_.data());
  add_tangents(false, terms, nodal.state(), linear.data());
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] -= linear[i];
  holds_rest_ = false;
  return solver_->factor(values_.data()) == FactorStatus::ok;
}

void Linearity::add_forces(bool exact, const Terms& terms, const NodalState& s, NodalVector& f) const {
  for (const std::size_t k : terms) {
    if (exact) {
      for (const auto& term : exact_[k]) term->add_force(s, f);
    } else {
      const ElasticTerm& elastic = *model_.parts().elastic[k];
      elastic.add_force(s, f);
      for (const AddedTerm* added : elastic.added()) added->add_force(s, f);
    }
  }
}

void Linearity::add_tangents(bool exact, const Terms& terms, const NodalState& s, double* K) const {
  for (const std::size_t k : terms) {
    if (exact) {
      for (const auto& term : exact_[k]) term->add_tangent(s, TangentKind::exact, K, nullptr);
    } else {
      const ElasticTerm& elastic = *model_.parts().elastic[k];
      elastic.add_tangent(s, TangentKind::exact, K, nullptr);
      for (const AddedTerm* added : elastic.added()) added->add_tangent(s, TangentKind::exact, K, nullptr);
    }
  }
}

void Linearity::add_correction(double t, const Vector& q, const Terms& terms, Vector& f) const {
  const FemModel::Parts& parts = model_.parts();
  const NodalExpansion nodal(parts, t, q, Vector::Zero(q.size()));
  NodalVector exact = NodalVector::Zero(3, nodal.x.cols()), linear = exact;
  add_forces(true, terms, nodal.state(), exact);
  add_forces(false, terms, nodal.state(), linear);
  Vector correction(q.size());
  parts.dofs->restrict_forces_to(exact - linear, correction);
  f += correction;
}

LinearityError Linearity::error(double t, const Vector& q, const Terms& terms) {
  const LinearityError found = distance(t, q, terms);
  const bool can_tell = mass_ == 0 && model_.pattern().symmetric && !q.isZero(0) && std::isfinite(found.displacement);
  if (!can_tell || factor_exact(t, q, terms)) return found;
  return {kUnknown, kUnknown, true};
}

LinearityError Linearity::distance(double t, const Vector& q, const Terms& terms) {
  Vector Mq(q.size()), Mx(q.size());
  model_.multiply_mass(q, Mq);
  const double square = q.dot(Mq);
  if (!(square > 0)) return {};
  const std::optional<Vector> x = shift(t, q, terms);
  if (!x) return {kUnknown, kUnknown};
  model_.multiply_mass(*x, Mx);
  return {norm(*x, Mx) / std::sqrt(square), std::abs(x->dot(Mq)) / square};
}

std::optional<Vector> Linearity::shift(double t, const Vector& q, const Terms& terms) {
  constexpr double kAccuracy = 0.02;  // relative accuracy of the shift
  constexpr double kSlowest = 0.7;    // largest accepted ratio of successive step energies
  constexpr int kMostTangents = 12;   // limit on exact tangents, which are used if the linear one converges slowly
  const Vector still = Vector::Zero(q.size());
  Vector at_q(q.size()), there(q.size()), step(q.size()), Mx(q.size());
  model_.multiply_mass(q, Mx);
  const double size = norm(q, Mx);
  Vector x = still;
  if (!(size > 0)) return x;
  try {
    if (!factor_for(t, q)) return std::nullopt;
    model_.force(t, q, still, at_q);
    int tangents = 0;
    for (double before = kUnknown;;) {
      model_.force(t, q + x, still, there);
      add_correction(t, q + x, terms, there);
      const Vector residual = there - at_q;
      solver_->solve(residual, step);
      x += step;
      const double energy = std::abs(step.dot(residual));
      model_.multiply_mass(step, Mx);
      const double last = norm(step, Mx);
      model_.multiply_mass(x, Mx);
      const double all = norm(x, Mx);
      if (last <= kAccuracy * all || std::max(last, all) <= kNegligible * size) return x;
      if (tangents > 0 || !(energy < kSlowest * before))
        if (++tangents > kMostTangents || !factor_exact(t, q + x, terms)) return std::nullopt;
      before = energy;
    }
  } catch (const RecoverableError&) {
    return std::nullopt;
  }
}

VibrationDrift Linearity::drift(double t, const Vector& mean, const Vector& swing, double omega) {
  const Vector still = Vector::Zero(mean.size());
  Vector Ms(mean.size()), at_base(mean.size()), there(mean.size());
  model_.multiply_mass(swing, Ms);
  const double square = swing.dot(Ms);
  if (!(square > 0) || !(omega > 0)) return {};
  // With large rotations the body does not pass through the mean shape. The whole shift at the end of the swing then
  // counts as odd.
  const bool is_linear = model_.traits().linear;
  const Vector base = is_linear ? mean : mean + swing;
  const auto shift_from = [&](const Vector& q) { return shift(t, q, terms_); };
  const std::optional<Vector> found = is_linear ? odd_part(shift_from, mean, swing) : shift_from(base);
  if (!found) return {kUnknown, 0};
  const Vector& x = *found;
  try {
    model_.force(t, base, still, at_base);
    model_.force(t, base, omega * swing, there);
    const double decay = std::max(swing.dot(at_base - there) / (2 * omega * square), 0.0);
    model_.force(t, base + x, still, there);
    const double by_mass = std::abs(x.dot(Ms)), by_stiffness = std::abs(swing.dot(at_base - there));
    return {std::min(omega * by_mass, std::sqrt(by_mass * by_stiffness)) / (2 * std::sqrt(square)), decay};
  } catch (const RecoverableError&) {
    return {kUnknown, 0};
  }
}

}  // namespace orthodyn
