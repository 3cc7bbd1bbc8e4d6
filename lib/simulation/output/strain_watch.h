// Whether a run strained its body beyond what the corotational law holds for (lib/analysis/strain_check.h): looks at
// outputs, and at steps where those are few, at which the elastic energy is larger than ever before.
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

// The worst of a run.
struct PassedStrain {
  double share = 0, time = 0;  // times the limit; s, of a static analysis the load factor
  std::string sentence = {};
};

class StrainWatch : public Observer {
 public:
  // Of a motion of `span`, s. The model must outlive it.
  static StrainWatch of_motion(const FemModel& model, double span) { return {model, std::nullopt, span / kLooks}; }
  // Of a static analysis; t of its states is the load factor.
  static StrainWatch of_equilibria(const FemModel& model, const PathTimes& times) {
    return {model, times, std::numeric_limits<double>::infinity()};
  }

  void on_output(const ObservedState& observed) override { look_at(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    if (std::abs(observed.t() - last_look_) >= interval_) look_at(observed);
  }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;
  const std::optional<PassedStrain>& worst() const { return worst_; }

 private:
  static constexpr double kLooks = 200;

  StrainWatch(const FemModel& model, const std::optional<PathTimes>& times, double interval)
      : model_(model), times_(times), interval_(interval) {}
  void look_at(const ObservedState& observed);
  std::optional<StrainExcess> of_all_ranks(std::optional<StrainExcess> here) const;

  const FemModel& model_;
  std::optional<PathTimes> times_;
  double interval_, last_look_ = -std::numeric_limits<double>::infinity();  // s
  double largest_energy_ = 0;                                               // J
  std::optional<PassedStrain> worst_;
};

}  // namespace orthodyn
