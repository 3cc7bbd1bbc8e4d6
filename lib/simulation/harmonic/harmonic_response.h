// The harmonic analysis of a scene: steady state, natural frequencies with their damping, and the response at any
// frequency of the range.
#pragma once

#include <optional>
#include <vector>

#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/harmonic/frequency_grid.h"
#include "lib/simulation/harmonic/response_columns.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

// The complex amplitude of the loads that vibrate, on the free coordinates about the displacements q, in N; inertia of
// a base that shakes included.
ComplexVector vibrating_load(const Scene& scene, const FemModel& model, const Vector& q);

class HarmonicResponse {
 public:
  // Computes everything but the response itself. `setup` must outlive this object. Throws ConfigError if no load
  // vibrates, if nothing damps the vibration, or if steady loads act on a body that is not held; RunError if the
  // equilibrium or the modes are not found.
  explicit HarmonicResponse(const Setup& setup);

  // The state about which the body vibrates: the equilibrium under the loads that do not vibrate.
  const State& about() const { return about_; }
  bool is_loaded() const { return is_loaded_; }  // there are steady loads
  const Modes& modes() const { return modes_; }  // up to kModesBeyond times the highest frequency
  // One for each mode.
  const std::vector<Resonance>& resonances() const { return resonances_; }
  // The number of modes that are not above the highest frequency.
  std::size_t modes_in_range() const;
  // Errors of the natural frequencies of modes_in_range() due to the mesh.
  FrequencyErrors mesh_errors() const;

  const std::vector<double>& frequencies() const { return frequencies_; }  // Hz, ascending
  const std::vector<ResponseColumn>& columns() const { return columns_; }
  // Complex amplitude of each column (row) at each frequency (column).
  const Eigen::MatrixXcd& amplitudes() const { return amplitudes_; }
  std::complex<double> amplitude(std::size_t column, double frequency) const;
  // The largest amplitude of a column in the range, between the frequencies too.
  struct Peak {
    double frequency = 0, amplitude = 0;  // Hz, the column's unit
  };
  Peak peak(std::size_t column) const;

  // A separate reduced system of the same vibration, and the range for which it is made.
  FrequencyResponse reduced_system() const;
  VibrationRange range() const;

  // The velocity of a column's vibration (0 for a rigid mode) by which a mode answers an impulse of 1 s times the
  // loads.
  double impulse_velocity(std::size_t column, std::size_t mode) const;

  double error() const { return response_->error(); }  // FrequencyResponse::error()
  FrequencyResponse::End end() const { return response_->end(); }
  Eigen::Index basis_size() const { return response_->basis().cols(); }

 private:
  State steady_state();
  Modes find_modes() const;
  void require_damping() const;

  const Setup& setup_;
  const FemModel& model_;
  bool is_loaded_ = false;
  State about_;
  Modes modes_;
  std::optional<FrequencyResponse> response_;
  std::vector<Resonance> resonances_;
  std::vector<double> frequencies_;
  std::vector<ResponseColumn> columns_;
  Eigen::MatrixXcd amplitudes_;
};

}  // namespace orthodyn
