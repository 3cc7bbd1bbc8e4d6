// The steady vibration of a model about a state under loads F cos(omega t), with small amplitudes:
//
//   (K + i H + i omega D - omega^2 M) x = F,   displacement = Re(x exp(i omega t)).
//
// K, D and M are the model's matrices at the state, H is the loss of the materials (hysteretic damping), and a damping
// ratio adds 2 zeta omega_k to the damping of each mode.
//
// The equation is projected onto a small real basis, with all its damping. The basis has the natural modes up to 1.5
// times the highest frequency and the static response to F. As long as the estimated error at a check frequency is
// above the tolerance, the response to the residual there is added. The estimate is the energy norm of that response,
// relative to the energy norm of x.
//
// Sources: Meirovitch, Principles and Techniques of Vibrations, 1997, ch. 7 (modes, structural damping); Cornwell,
// Craig & Johnson, Earthquake Eng. Struct. Dyn. 11, 1983 (static response as an additional vector).
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/linear/solver.h"

namespace orthodyn {

using ComplexVector = Eigen::VectorXcd;

// Damping in addition to the model's own.
struct VibrationDamping {
  double ratio = 0;          // zeta of each mode
  std::vector<double> loss;  // H, values on the model's pattern; may be empty
};

struct VibrationRange {
  std::vector<double> checks;  // Hz, ascending: frequencies at which the error is estimated; the last is the highest
  double rtol = 1e-4;
};

class FrequencyResponse {
 public:
  // `modes`: all modes up to kModesBeyond times the highest frequency, about this state. `load`: F on the unknowns, N.
  // Throws ConfigError if a mode is unstable, RunError if the shifted stiffness cannot be factored. `model` must
  // outlive this object.
  FrequencyResponse(const Model& model, const State& about, const Modes& modes, const ComplexVector& load,
                    VibrationDamping damping, const VibrationRange& range);

  // Coordinates of x in the basis, at a frequency in Hz.
  ComplexVector coordinates(double frequency) const;
  const Eigen::MatrixXd& basis() const { return basis_; }  // M-orthonormal columns; the modes come first

  // phi_k^T F of a mode.
  std::complex<double> modal_load(int mode) const { return reduced_load_[mode]; }

  // Loss factor of a mode at its natural frequency: twice its damping ratio. 0 for a rigid mode.
  double loss_factor(int mode) const;

  // The largest estimated relative error at the check frequencies, in the energy norm.
  double error() const { return error_; }

 private:
  using Values = std::vector<double>;  // of a matrix on the model's pattern

  Eigen::MatrixXcd projected(double omega) const;
  Vector product(const Values& values, const Vector& x) const;
  void factor();
  bool add(Vector direction);
  ComplexVector residual(double omega, const ComplexVector& y) const;
  ComplexVector response_to(const ComplexVector& force);
  void add_until(const VibrationRange& range);

  const Model& model_;
  Values stiffness_, mass_, viscous_, loss_;
  Vector omega_;  // natural frequencies of the modes, rad/s
  double ratio_;
  ComplexVector load_;
  double shift_ = 0;  // s, 1/s^2: the solver has a factor of K + s M
  std::unique_ptr<LinearSolver> solver_;
  Eigen::MatrixXd basis_, mass_times_basis_;
  Eigen::MatrixXd reduced_stiffness_, reduced_viscous_, reduced_loss_;
  ComplexVector reduced_load_;
  double error_ = 0;
};

// Factor on the highest frequency, up to which FrequencyResponse needs the modes.
inline constexpr double kModesBeyond = 1.5;

}  // namespace orthodyn
