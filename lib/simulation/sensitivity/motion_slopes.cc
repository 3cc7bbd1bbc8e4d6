#include "lib/simulation/sensitivity/motion_slopes.h"

namespace orthodyn {

std::vector<std::string> MotionSlopes::paths() const {
  std::vector<std::string> all;
  for (const SceneParameter& parameter : sensitivity_.parameters()) all.push_back(parameter.path());
  return all;
}

std::vector<double> MotionSlopes::derivatives(const SceneOutputs& output, const State& state) const {
  std::vector<double> all;
  for (int i = 0; i < sensitivity_.count(); ++i) {
    State slope;
    if (state.t <= start_) slope = sensitivity_.initial(i);
    else integrator_.interpolate_sensitivity(i, state.t, slope);
    all.push_back(sensitivity_.derivative(i, state, slope, output)[0]);
  }
  return all;
}

}  // namespace orthodyn
