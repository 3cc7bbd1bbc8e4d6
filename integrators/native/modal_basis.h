// The lowest modes of a linear model, K phi = lambda M phi, and the static response of all the others:
//
//   q = Phi r + S (f - M Phi Phi' f),   S = (K + s M)^-1,
//
// by one factorisation. s = 0 where the body is held; where it is not, s is a millionth of the highest kept lambda.
// What S returns is M-orthogonal to the modes.
// Source: Hughes, The Finite Element Method, 1987, 7.2 (modes); Cornwell, Craig & Johnson, Earthquake Eng. Struct. Dyn.
// 11, 1983 (mode acceleration).
#pragma once

#include <memory>
#include <optional>

#include "lib/linear/solver.h"
#include "lib/ode/model.h"

namespace orthodyn {

// Which modes: so many, or all below a frequency.
struct ModeLimit {
  std::optional<int> modes;
  std::optional<double> below;  // Hz
};

class ModalBasis {
 public:
  // `model` must outlive this. Throws ConfigError if the model is not linear, if its damping couples the modes, if a
  // rigid motion would be left out, or if there is no mode within the limit; RunError if the modes cannot be found.
  ModalBasis(const Model& model, const ModeLimit& limit);

  const Vector& lambda() const { return lambda_; }    // 1/s^2, ascending, at least 0
  const Vector& damping() const { return damping_; }  // 1/s, of each
  Eigen::Index size() const { return lambda_.size(); }

  // Of the first mode left out; where none is, is_complete() holds.
  double next_lambda() const { return next_lambda_; }
  double next_damping() const { return next_damping_; }
  bool is_complete() const { return complete_; }

  const Eigen::MatrixXd& shapes() const { return shapes_; }
  Vector coordinates(const Vector& q) const;  // Phi' M q

  // S (f - M Phi Phi' f), with Phi' f at hand; zero if no mode is left out. Uses work space: not thread-safe.
  Vector static_rest(const Vector& f, const Vector& modal) const;
  Vector static_rest(const Vector& f) const { return static_rest(f, shapes_.transpose() * f); }

  Vector times_mass(const Vector& x) const;
  Vector times_damping(const Vector& x) const;
  Vector times_stiffness(const Vector& x) const;

  std::size_t factor_bytes() const { return solver_ ? solver_->factor_bytes() : 0; }
  std::size_t bytes() const;

 private:
  void take_modes(const ModeLimit& limit);
  void take_count(int count);
  void take_below(double frequency);
  void take_damping();
  void take_other_damping();
  [[noreturn]] void refuse_coupled_damping(double share) const;
  void factor();

  const Model& model_;
  Linearization at_;
  std::vector<double> stiffness_, mass_, drag_;  // drag_ is empty without damping
  Vector lambda_, damping_;
  Eigen::MatrixXd shapes_;
  double next_lambda_ = 0, next_damping_ = 0, resolution_ = 0;
  bool complete_ = false, shifted_ = false;
  std::unique_ptr<LinearSolver> solver_;  // none where no mode is left out
};

}  // namespace orthodyn
