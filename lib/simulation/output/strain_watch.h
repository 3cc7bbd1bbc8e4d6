// Monitors whether strains exceed the validity limit of the corotational law (lib/analysis/strain_check.h). Strains
// near the limit are evaluated when the elastic energy reaches a new maximum. This is checked at outputs and, where
// outputs are rare, at steps.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/analysis/strain_check.h"
#include "lib/simulation/output/observer.h"
#include "lib/statics/load_path.h"

namespace orthodyn {

// The largest excess over the strain limit in a run.
struct ExceededStrain {
  double share = 0, time = 0;  // strain over its limit; time in s, in a static analysis the load factor
  std::string sentence = {};
};

class StrainWatch : public Observer {
 public:
  // For a motion of length `span` (s). The model must outlive the watch.
  static StrainWatch of_motion(const FemModel& model, double span) {
    return {model, std::nullopt, span / kEvaluations};
  }
  // For a static analysis; State::t is the load factor.
  static StrainWatch of_equilibria(const FemModel& model, const PathTimes& times) {
    return {model, times, std::numeric_limits<double>::infinity()};
  }

  void on_output(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    if (std::abs(observed.t() - last_evaluation_) >= interval_) observe(observed);
  }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;
  const std::optional<ExceededStrain>& worst() const { return worst_; }

 private:
  static constexpr double kEvaluations = 200;

  StrainWatch(const FemModel& model, const std::optional<PathTimes>& times, double interval)
      : model_(model), safe_(safe_green_strains(model)), times_(times), interval_(interval) {}
  void observe(const ObservedState& observed);
  std::optional<StrainExcess> of_all_ranks(std::optional<StrainExcess> here) const;

  const FemModel& model_;
  std::vector<double> safe_;  // safe_green_strains()
  std::optional<PathTimes> times_;
  double interval_, last_evaluation_ = -std::numeric_limits<double>::infinity();  // s
  double largest_energy_ = 0;                                                     // J
  std::optional<ExceededStrain> worst_;
};

}  // namespace orthodyn
