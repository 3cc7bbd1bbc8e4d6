// The steady vibration of a model about a state under loads F cos(omega t), with small amplitudes:
//
//   (K + i H + i omega D - omega^2 M + sum_tau i omega tau / (1 + i omega tau) K_tau) x = F,
//
// displacement = Re(x exp(i omega t)). K, D and M are the model's matrices at the state, H is the loss of the materials
// (hysteretic damping), and a damping ratio adds 2 zeta omega_k to the damping of each mode. K is the relaxed stiffness
// of viscoelastic materials, and K_tau the stiffness that relaxes with the time tau (lib/ode/internal_variables.h).
//
// The equation is projected onto a small real basis, with all its damping. The basis has the natural modes up to 1.5
// times the highest frequency and the static response to F, for a free body without the part that moves it rigidly. As
// long as the estimated error at a check frequency is above the tolerance, the response to the residual there is added.
// The estimate is the elastic energy norm of that response, relative to that of x. It does not contain the coupling of
// this response with the modes by damping.
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
  // Why the basis was not extended further: the error is below the tolerance, further vectors do not reduce it
  // (round-off), or there are too many.
  enum class End { converged, stagnated, too_many };

  // `modes`: all modes up to kModesBeyond times the highest frequency, about this state. `load`: F on the unknowns, N.
  // Throws ConfigError if a mode is unstable, RunError if the shifted stiffness cannot be factored. `model` must
  // outlive this object.
  FrequencyResponse(const Model& model, const State& about, const Modes& modes, const ComplexVector& load,
                    VibrationDamping damping, const VibrationRange& range);

  // Coordinates of x in the basis, at a frequency in Hz. Thread-safe.
  ComplexVector coordinates(double frequency) const { return coordinates(frequency, reduced_load_); }
  // Likewise, for another load with these products with the vectors of the basis.
  ComplexVector coordinates(double frequency, const ComplexVector& reduced_load) const;
  // Extends the basis until it also has the response to another load (N) within the tolerance. error() and end() are
  // then those of this load.
  void include(const ComplexVector& load, const VibrationRange& range);
  const Eigen::MatrixXd& basis() const { return basis_; }  // M-orthonormal columns; the modes come first

  // V^T K V with the basis V: the eigenvalues of the modes, and a block of the further vectors.
  const Eigen::MatrixXd& reduced_stiffness() const { return reduced_stiffness_; }

  // phi_k^T F of a mode.
  std::complex<double> modal_load(int mode) const { return reduced_load_[mode]; }

  // Natural frequency of a mode (Hz) with the stiffness at this frequency, which for viscoelastic materials is above
  // the relaxed one.
  double frequency(int mode) const;

  // Loss factor of a mode at its natural frequency: twice its damping ratio. 0 for a rigid mode. Modes whose
  // frequencies are closer than their damping have the loss factors of the damped modes among them.
  double loss_factor(int mode) const { return loss_factors_[mode]; }

  // The largest estimated relative error at the check frequencies, in the energy norm.
  double error() const { return error_; }
  End end() const { return end_; }

 private:
  using Values = std::vector<double>;  // of a matrix on the model's pattern

  Vector product(const Values& values, const Vector& x) const;
  ComplexVector product(const Values& values, const ComplexVector& x) const;
  void set_loss_factors();
  void factor();
  bool add(Vector direction);
  bool add_parts(const ComplexVector& x);
  Vector without_rigid_motion(Vector x) const;
  ComplexVector residual(double omega, const ComplexVector& y) const;
  ComplexVector response_to(const ComplexVector& force);
  ComplexVector reduced(const ComplexVector& load) const;
  void extend_basis(const VibrationRange& range);
  void find_coupled(double tolerance);

  const Model& model_;
  // The stiffness that relaxes with one time, and its products with the basis.
  struct Branch {
    double time;  // s
    Values stiffness;
    Eigen::MatrixXd reduced;
    std::complex<double> factor(double omega) const {
      const std::complex<double> x(0, omega * time);
      return x / (1.0 + x);
    }
  };
  void find_branches(const State& about);
  double frequency_of_mode(Eigen::Index k) const;  // rad/s
  std::complex<double> relaxing(double omega, Eigen::Index j, Eigen::Index k) const;

  Values stiffness_, mass_, viscous_, loss_;
  std::vector<Branch> branches_;  // only with viscoelastic materials
  Vector omega_;                  // of the modes with the stiffness at their frequencies, rad/s
  Vector lambda_;                 // of the modes, 1/s^2
  Eigen::Index zeros_ = 0;        // number of zero modes
  double ratio_;
  ComplexVector load_;
  std::unique_ptr<LinearSolver> solver_;  // of K + s M
  Eigen::MatrixXd basis_, mass_times_basis_;
  Eigen::MatrixXd reduced_stiffness_, reduced_viscous_, reduced_loss_;
  ComplexVector reduced_load_;
  std::vector<Eigen::Index> coupled_, alone_;  // indices of the basis: coupled by damping or stiffness, or not
  Vector loss_factors_;
  double error_ = 0;
  End end_ = End::converged;
};

// Factor on the highest frequency, up to which FrequencyResponse needs the modes.
inline constexpr double kModesBeyond = 1.5;

}  // namespace orthodyn
