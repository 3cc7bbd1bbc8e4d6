// Derivatives of the response in a harmonic analysis with respect to numbers of the scene.
//
// The vibration x solves Z x = F with the symmetric Z = K + i H + i omega D - omega^2 M. For a displacement q^T x with
// fixed q, and the adjoint vibration w with Z w = q,
//
//     d(q^T x)/dp = w^T (dF/dp - dZ/dp x).
//
// Both vibrations are computed in one reduced basis, which is extended until it has w as accurately as x. The error of
// the derivative is then of the order of harmonic.rtol, relative to the product of the norms of w and dZ/dp x. This is
// the derivative of the reduced amplitude for a fixed basis.
//
// dZ/dp includes the change of the steady state and the change of the modal damping by harmonic.damping_ratio. The
// modal damping is 2 zeta M (M^-1 K)^(1/2) on the modes; this matrix function is differentiated by the formula of
// Daleckii & Krein (Higham, Functions of Matrices, 2008, theorem 3.11). dK/dp, dM/dp, dH/dp and dF/dp are differences
// between changed models (changed_models.h).
#pragma once

#include <complex>
#include <vector>

#include "lib/simulation/harmonic/harmonic_response.h"
#include "lib/simulation/sensitivity/changed_models.h"

namespace orthodyn {

class ResponseSensitivity {
 public:
  // `config`: resolved input of `setup`. `columns`: indices of the columns of `response`, which must be displacements,
  // velocities or accelerations. All but the lists must outlive this object. Throws ConfigError if a parameter changes
  // the mesh's connections; RunError if the steady state has no derivative.
  ResponseSensitivity(const Config& config, const Setup& setup, const HarmonicResponse& response,
                      const std::vector<std::size_t>& columns, const std::vector<SceneParameter>& parameters);

  // The derivatives of the complex amplitude of a column at a frequency (Hz), one per parameter, per SI unit of it.
  // `column`: one of `columns` above. Thread-safe.
  std::vector<std::complex<double>> derivatives(std::size_t column, double frequency) const;

 private:
  // Derivatives of the reduced matrices by a parameter.
  struct Slopes {
    Eigen::MatrixXd stiffness, mass, loss, damping;
    ComplexVector load;
    Vector base;  // of each column of the response
  };

  Vector output(const ResponseColumn& column) const;
  Slopes slopes(const ChangedModels& changed_models) const;
  Vector slope_of_state(const ChangedModels& changed_models) const;
  Eigen::MatrixXd slope_of_modal_damping(const Slopes& slopes, double ratio_slope) const;

  const Setup& setup_;
  const HarmonicResponse& response_;
  FrequencyResponse system_;
  std::vector<Vector> outputs_;  // V^T q by column; empty for columns that are not wanted
  std::vector<Slopes> slopes_;
};

// Whether a column's derivatives are computed: strains and stresses depend on the parameter also at a fixed vibration.
inline bool has_sensitivity(const ResponseColumn& column) { return column.is_motion; }

// d|a|/dp and d(phase)/dp (rad) from da/dp.
inline double amplitude_slope(std::complex<double> a, std::complex<double> slope) {
  return (std::conj(a) * slope).real() / std::abs(a);
}
inline double phase_slope(std::complex<double> a, std::complex<double> slope) { return (slope / a).imag(); }

}  // namespace orthodyn
