// Mesh error of a run: E / (E + computed elastic energy) with the elastic energy E of the error. E is estimated by
// finer elements (estimated_error.h) in the most deformed state, or by recovered stresses (lib/fem/stress_recovery.h)
// in several states. For loads that change slowly, deflections are too small by about this relative error, and natural
// frequencies are too high by half of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// A mesh with a larger relative error is reported as coarse.
inline constexpr double kCoarseMesh = 0.05;

// Mesh error of a probed field other than displacement and velocity; `scale` and `error` as in FieldError.
struct ProbedError {
  std::string probe, field, unit;
  double scale = 0, error = 0;
  double share() const { return scale > 0 ? error / scale : 0; }
};

// A mesh with a larger relative error of a probed stress or strain is reported as coarse.
inline constexpr double kCoarseStress = 0.1;

struct MeshError {
  double relative = 0;                   // E / (E + computed elastic energy)
  int samples = 0;                       // states evaluated
  bool by_finer_elements = false;        // else by recovered stresses
  std::string locking_risk = {};         // locking that the estimate may miss, and a remedy; or ""
  double cpu_seconds = 0;                // for the finer elements
  std::vector<ProbedError> probed = {};  // empty without finer elements
  bool probed_unknown = false;           // fields are probed, but their errors are unknown
};

class MeshErrorRecorder : public Observer {
 public:
  // Evaluates at most 8 of the `outputs` outputs, including the last. With a model, found() evaluates only the most
  // deformed of these states, by the elements' elastic energy: for a run whose estimate by finer elements needs no
  // other. It is then the result of such a run if that estimate fails, or if the run does not complete.
  explicit MeshErrorRecorder(std::size_t outputs, const FemModel* only_most_deformed = nullptr);
  void on_output(const ObservedState& observed) override;

  // Evaluates a state other than an output.
  void observe(const ObservedState& observed);

  // The mesh error by recovered stresses. Empty if the elastic energy is at most 1e-6 of the kinetic energy, as in a
  // rigid-body motion; both are summed over the evaluated states.
  std::optional<MeshError> found() const;

  // The evaluated state with the largest elastic energy.
  const std::optional<State>& most_deformed() const { return most_deformed_; }

 private:
  const FemModel* only_most_deformed_;
  std::size_t outputs_, stride_, seen_ = 0;
  double error_ = 0, elastic_ = 0, kinetic_ = 0;  // sums, J
  int samples_ = 0;
  double largest_ = 0;  // elastic energy, J
  std::optional<State> most_deformed_;
};

}  // namespace orthodyn
