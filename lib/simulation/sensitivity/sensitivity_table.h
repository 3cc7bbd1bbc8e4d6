// sensitivities.csv of a run: derivatives of probes, gauges, reactions and energies with respect to the scene's
// `sensitivities`.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/simulation/output/curves.h"
#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"

namespace orthodyn {

// The quantities of the table: the columns of probes.csv, and the elastic and kinetic energy if the scene writes
// energies. Throws ConfigError if there are none.
ProbeColumns sensitivity_quantities(const Scene& scene, const FemModel& model);

// Writes a row at each time of the history. In a checkpoint it saves the derivatives of the state.
class SensitivityWriter : public TableWriter {
 public:
  // All arguments must outlive the writer.
  SensitivityWriter(const std::filesystem::path& path, const Scene& scene, const FemModel& model,
                    const Integrator& integrator, MotionSensitivity& sensitivity);
  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override;
  void on_history(const ObservedState& observed) override;
  void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override { reached_ = info.t; }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  State slope(int i, double t) const;
  void begin_at(double t) { start_ = reached_ = t; }

  ProbeColumns quantities_;
  const Integrator& integrator_;
  MotionSensitivity& sensitivity_;
  double start_ = 0, reached_ = 0;  // start of the integration and end of its last step, s
};

// Writes the table of an equilibrium, which has one row.
void write_sensitivities(const std::filesystem::path& path, const Scene& scene, const FemModel& model,
                         const EquilibriumSensitivity& sensitivity, const std::vector<SceneParameter>& parameters);

}  // namespace orthodyn
