// How far the mesh puts a run off, by recovered stresses (lib/fem/stress_recovery.h): the share of the elastic energy
// that the error takes, over some states of the run. As the energy of a body under given loads, its deflections are
// too small by about that share where they follow the loads slowly, and natural frequencies too high by half of it.
#pragma once

#include <optional>

#include "lib/simulation/observers/observer.h"

namespace orthodyn {

// From this share of the elastic energy on a mesh is called coarse.
inline constexpr double kCoarseMesh = 0.05;

struct MeshError {
  double relative = 0;  // of the elastic energy
  int samples = 0;      // states that were looked at
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

 private:
  std::size_t outputs_, stride_, seen_ = 0;
  double error_ = 0, elastic_ = 0, kinetic_ = 0;  // J, sums
  int samples_ = 0;
};

}  // namespace orthodyn
