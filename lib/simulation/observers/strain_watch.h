// Whether a run strained its body beyond what the corotational law holds for (lib/analysis/strain_check.h): looks at
// outputs at which the elastic energy is larger than ever before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/analysis/strain_check.h"
#include "lib/simulation/observers/observer.h"

namespace orthodyn {

// The worst of a run.
struct PassedStrain {
  double share = 0, time = 0;  // times the limit; s, of a static analysis the load factor
  std::string sentence = {};
};

class StrainWatch : public Observer {
 public:
  // The model must outlive it. `loads_at`, s: of a static analysis, of whose states t is the load factor.
  explicit StrainWatch(const FemModel& model, std::optional<double> loads_at = {})
      : model_(model), loads_at_(loads_at) {}

  void on_output(const ObservedState& observed) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;
  const std::optional<PassedStrain>& worst() const { return worst_; }

 private:
  const FemModel& model_;
  std::optional<double> loads_at_;
  double largest_energy_ = 0;  // J
  std::optional<PassedStrain> worst_;
};

}  // namespace orthodyn
