// The lowest modes of a linear model, K phi = lambda M phi, and the static correction for all other modes. With the
// modes as columns of Phi and the modal coordinates r, the position under a load f is
//
//   q = Phi r + S (f - M Phi Phi^T f),   S = (K + s M)^-1.
//
// K + s M is factored once. s = 0 if the body is held; otherwise s is at least a millionth of the lowest lambda that
// the basis leaves out, and larger if the factorisation needs it. The correction is M-orthogonal to the modes.
//
// Source: Hughes, The Finite Element Method, 1987, 7.2 (modes); Cornwell, Craig & Johnson, Earthquake Eng. Struct. Dyn.
// 11, 1983 (mode acceleration).
#pragma once

#include <memory>
#include <optional>

#include "lib/linear/solver.h"
#include "lib/ode/model.h"

namespace orthodyn {

// The modes to keep: either a number of modes, or all modes below a frequency.
struct ModeLimit {
  std::optional<int> modes;
  std::optional<double> below;  // Hz
};

class ModalBasis {
 public:
  // `model` must outlive this object. Throws ConfigError if the model is nonlinear or unstable at rest, if its damping
  // couples the modes, if a rigid motion would be left out, or if no mode is within the limit; RunError if the modes
  // cannot be computed or the stiffness cannot be factored.
  ModalBasis(const Model& model, const ModeLimit& limit);

  const Vector& lambda() const { return lambda_; }    // 1/s^2, ascending, at least 0
  const Vector& damping() const { return damping_; }  // 1/s, modal damping d
  Eigen::Index size() const { return lambda_.size(); }

  // Damping (1/s) of the first mode left out; 0 if unknown. Has no meaning if is_complete().
  double next_damping() const { return next_damping_; }
  bool is_complete() const { return complete_; }  // true if no mode is left out

  const Eigen::MatrixXd& shapes() const { return shapes_; }
  Vector coordinates(const Vector& q) const;  // Phi^T M q

  // The static correction S (f - M Phi Phi^T f); `modal` is Phi^T f. Zero if no mode is left out. Not thread-safe.
  Vector static_correction(const Vector& f, const Vector& modal) const;
  Vector static_correction(const Vector& f) const { return static_correction(f, shapes_.transpose() * f); }

  Vector times_mass(const Vector& x) const;
  Vector times_damping(const Vector& x) const;
  Vector times_stiffness(const Vector& x) const;

  std::size_t factor_bytes() const { return solver_ ? solver_->factor_bytes() : 0; }
  std::size_t bytes() const;

 private:
  void find_modes(const ModeLimit& limit);
  void find_lowest(int count);
  void find_below(double frequency);
  void set_modal_damping();
  void set_general_damping();
  [[noreturn]] void refuse_coupled_damping(double share) const;
  void factor();

  const Model& model_;
  Linearization at_;
  std::vector<double> stiffness_, mass_, damping_entries_;  // on the pattern; damping_entries_ is empty without damping
  Vector lambda_, damping_;
  Eigen::MatrixXd shapes_;
  double next_lambda_ = 0, next_damping_ = 0, resolution_ = 0;
  bool complete_ = false, shifted_ = false;
  std::unique_ptr<LinearSolver> solver_;  // null if no mode is left out
};

}  // namespace orthodyn
