// How far the mesh puts a run off: the share of the elastic energy that the error takes. By finer elements
// (estimated_error.h) in the state that is deformed the most, or by recovered stresses (lib/fem/stress_recovery.h) over
// some states of the run. As the energy of a body under given loads, its deflections are
// too small by about that share where they follow the loads slowly, and natural frequencies too high by half of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"

namespace orthodyn {

// From this share of the elastic energy on a mesh is called coarse.
inline constexpr double kCoarseMesh = 0.05;

// Error by the mesh of a field that a probe records, other than displacement and velocity; `scale` and `error` as in
// FieldError.
struct ProbedError {
  std::string probe, field, unit;
  double scale = 0, error = 0;
  double share() const { return scale > 0 ? error / scale : 0; }
};

// Above this relative error of a probed stress or strain the mesh is reported as coarse.
inline constexpr double kCoarseStress = 0.1;

struct MeshError {
  double relative = 0;                   // of the elastic energy
  int samples = 0;                       // states that were looked at
  bool by_finer_elements = false;        // else by recovered stresses
  std::string blind = {};                // what the estimate may not see, and what to do, in a sentence; "" if nothing
  double cpu_seconds = 0;                // that the finer elements took
  std::vector<ProbedError> probed = {};  // by finer elements; empty without these
  bool probed_unknown = false;           // probes record such fields, and no error is known of them
};

class MeshErrorRecorder : public Observer {
 public:
  // Looks at some of this many outputs, and the last one.
  explicit MeshErrorRecorder(std::size_t outputs);
  void on_output(const ObservedState& observed) override;

  // Of one state, beside the outputs.
  void look_at(const ObservedState& observed);

  // None where nothing was deformed to speak of.
  std::optional<MeshError> found() const;

  // Of those that were looked at the one of the largest elastic energy.
  const std::optional<State>& most_deformed() const { return most_deformed_; }

 private:
  std::size_t outputs_, stride_, seen_ = 0;
  double error_ = 0, elastic_ = 0, kinetic_ = 0;  // J, sums
  int samples_ = 0;
  double largest_ = 0;  // J, elastic
  std::optional<State> most_deformed_;
};

}  // namespace orthodyn
