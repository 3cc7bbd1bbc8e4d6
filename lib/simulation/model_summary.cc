#include "lib/simulation/model_summary.h"

namespace orthodyn {

ModelSummary summarize(const Setup& setup) {
  const FemModel& model = *setup.built.model;
  const auto& parts = model.parts();
  ModelSummary out{parts.mesh.nodes.size(), parts.mesh.tets.size(),       model.num_dofs(),
                   parts.mesh.order(),      parts.elastic.front()->law(), {}};
  for (const auto& term : parts.elastic) out.terms.push_back(term->description());
  for (const auto& term : parts.loads) out.terms.push_back(term->description());
  out.kinematics = told_kinematics(setup);
  return out;
}

std::string told_kinematics(const Setup& setup) {
  if (setup.linearity) return outcome_of(*setup.linearity);
  return setup.kinematics ? setup.kinematics->reason : "";
}

}  // namespace orthodyn
