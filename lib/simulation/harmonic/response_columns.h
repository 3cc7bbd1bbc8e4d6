// The quantities of a harmonic analysis: amplitudes of fields at the probes, and of gauges.
#pragma once

#include <string>
#include <vector>

#include "lib/analysis/frequency_response.h"
#include "lib/scene/scene.h"

namespace orthodyn {

class FemModel;

// A component of a field at a probe, or a value of a gauge, as a linear function of the vibration.
struct ResponseColumn {
  std::string probe;     // or gauge
  std::string name;      // "bridge.velocity.z"
  std::string unit;      // "m/s"
  int time_derivative;   // 0, 1 or 2, of the vibration
  bool is_motion;        // displacement, velocity or acceleration
  double base = 0;       // the same component of the base's acceleration, m/s^2; 0 unless the field is a motion
  Vector of_basis = {};  // values of the vectors of the basis; with viscoelastic materials, relaxed
  struct Relaxing {
    double time;      // s
    Vector of_basis;  // the part of the values that relaxes with this time
  };
  std::vector<Relaxing> relaxing = {};

  // Complex amplitude at a frequency (Hz) of a vibration with these coordinates in the basis.
  std::complex<double> amplitude(double frequency, const ComplexVector& coordinates) const;
};

// Columns of all probes, fields and components, without `of_basis`. Fields are displacement, velocity, acceleration and
// those that are linear in a small displacement: nodal strains and stresses. Throws ConfigError for others. Gauges
// follow; the amplitude of a length is that of its change.
std::vector<ResponseColumn> response_columns(const Scene& scene, const FemModel& model);

// Index of a column. Throws ConfigError at `origin` if the scene has no such quantity.
std::size_t find_column(const std::vector<ResponseColumn>& columns, const std::string& quantity,
                        const SourceLocation& origin);

// Sets `of_basis` and `relaxing` of the columns. Strains, lengths and stresses are differences of second order about
// the state.
void set_basis(std::vector<ResponseColumn>& columns, const Scene& scene, const FemModel& model, const State& about,
               const Eigen::MatrixXd& basis);

}  // namespace orthodyn
