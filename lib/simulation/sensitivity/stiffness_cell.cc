#include "lib/simulation/sensitivity/stiffness_cell.h"

#include <charconv>
#include <set>
#include <string_view>

#include "lib/fem/terms/added_term.h"
#include "lib/scene/region.h"

namespace orthodyn {

namespace {

constexpr std::string_view kBefore = "regions.", kBetween = ".stiffness_factors.values.";

}  // namespace

bool StiffnessCell::is_path(const std::string& path) {
  return path.starts_with(kBefore) && path.find(kBetween) != std::string::npos;
}

std::optional<StiffnessCell> StiffnessCell::find(const std::string& path, const Scene& scene, const FemModel& model) {
  if (!is_path(path)) return {};
  const auto between = path.find(kBetween);
  const std::string region = path.substr(kBefore.size(), between - kBefore.size());
  int cell = -1;
  const char* const number = path.data() + between + kBetween.size();
  std::from_chars(number, path.data() + path.size(), cell);
  std::vector<const Term*> terms;
  std::set<int> nodes;
  double factor = 1;
  for (const auto& term : model.parts().elastic) {
    const ElasticRegion& own = term->definition();
    if (own.stiffness_cell != cell || cell < 0 || entry_of(scene, own.mesh_region).first != region) continue;
    terms.push_back(term.get());
    for (const AddedTerm* added : term->added())
      if (added->scales_with_stiffness()) terms.push_back(added);
    factor = own.stiffness_factor;
    for (const int element : own.cells)
      for (const int node : model.parts().mesh.cells[static_cast<std::size_t>(element)]) nodes.insert(node);
  }
  return StiffnessCell(model, std::move(terms), {nodes.begin(), nodes.end()}, factor);
}

Vector StiffnessCell::force(const State& state) const {
  const auto& parts = model_->parts();
  const NodalExpansion nodal(parts, state.t, state.q, state.v, state.load_factor);
  Vector out(model_->num_dofs());
  parts.dofs->restrict_forces_to(term_forces(parts, nodal, terms_), out);
  return out / factor_;
}

double StiffnessCell::product(const NodalExpansion& nodal, const NodalVector& weights, NodalVector& work) const {
  for (const Term* term : terms_) term->add_force(nodal.state(), work);
  double sum = 0;
  for (const int node : nodes_) {
    sum += weights.col(node).dot(work.col(node));
    work.col(node).setZero();
  }
  return sum / factor_;
}

double StiffnessCell::energy(const State& state) const {
  const auto& parts = model_->parts();
  const NodalExpansion nodal(parts, state.t, state.q, state.v, state.load_factor);
  double sum = 0;
  for (const Term* term : terms_) sum += term->energy(nodal.state());
  return sum / factor_;
}

}  // namespace orthodyn
