// The largest error of the joints over all steps: how far joined points are apart, and how fast they part.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct JointErrors {
  double gap = 0, rate = 0;             // m, m/s
  std::vector<std::string> wound = {};  // hinges with a spring or stop that have turned by more than half a turn
};

class JointWatch : public Observer {
 public:
  // `sprung`: names of the joints with a spring or stop along their angle. Springs and stops take angles from -pi to
  // pi.
  explicit JointWatch(std::vector<std::string> sprung) : sprung_(std::move(sprung)), farthest_(sprung_.size(), 0.0) {}

  void on_start(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { observe(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  JointErrors largest() const;

 private:
  void observe(const ObservedState& observed);

  JointErrors largest_;
  std::vector<std::string> sprung_;
  std::vector<double> farthest_;  // largest angle of each, rad
};

}  // namespace orthodyn
