#include "lib/simulation/run/model_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/spelling.h"
#include "lib/fem/contact/contact.h"

namespace orthodyn {

namespace {

std::string laws_of(const FemModel& model) {
  std::vector<std::string> laws;
  for (const auto& term : model.parts().elastic)
    if (std::find(laws.begin(), laws.end(), term->law()) == laws.end()) laws.push_back(term->law());
  return laws.empty() ? "none: all bodies are rigid" : join(laws, "; ");
}

}  // namespace

ModelSummary summarize(const Setup& setup) {
  const FemModel& model = *setup.built.model;
  const auto& parts = model.parts();
  ModelSummary out{parts.mesh.nodes.size(), parts.mesh.cells.size(), static_cast<int>(model.num_dofs_of_all()),
                   parts.mesh.order(),      laws_of(model),          term_descriptions(parts)};
  if (parts.mass_damping > 0)
    out.terms.push_back(fmt::format("mass-proportional damping of {:.6g} 1/s", parts.mass_damping));
  out.kinematics = kinematics_summary(setup);
  if (setup.linearity && !std::isnan(setup.linearity->error())) out.linear_error = setup.linearity->error();
  out.buckles = setup.linearity && setup.linearity->unstable();
  out.has_barrier = std::any_of(parts.loads.begin(), parts.loads.end(), [](const auto& term) {
    return term->contact() && term->contact()->refuses_crossing();
  });
  return out;
}

std::string kinematics_summary(const Setup& setup) {
  std::string summary = setup.linearity ? linearity_summary(*setup.linearity) : "";
  if (setup.kinematics && !setup.kinematics->reason.empty())
    summary += (summary.empty() ? "" : "; ") + setup.kinematics->reason;
  return summary;
}

}  // namespace orthodyn
