// The largest error of the joints over all steps: how far joined points are apart, and how fast they part.
#pragma once

#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct JointErrors {
  double gap = 0, rate = 0;  // m, m/s
};

class JointWatch : public Observer {
 public:
  void on_start(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { observe(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  const JointErrors& largest() const { return largest_; }

 private:
  void observe(const ObservedState& observed);

  JointErrors largest_;
};

}  // namespace orthodyn
