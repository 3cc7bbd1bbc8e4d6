#include "lib/simulation/error_estimate/recorders.h"

namespace orthodyn {

void TrajectoryRecorder::on_start(const ObservedState& observed) {
  const State state = state_of(observed);
  const auto columns = static_cast<Eigen::Index>(outputs_) + 1;
  Eigen::Index components = 0;
  for (const auto& quantity : quantities_) components += quantity.components();
  trajectory_ = {{},
                 Eigen::MatrixXd::Zero(state.q.size(), columns),
                 Eigen::MatrixXd::Zero(state.v.size(), columns),
                 Eigen::MatrixXd::Zero(components, columns)};
  on_output(observed);
}

void TrajectoryRecorder::on_output(const ObservedState& observed) {
  const State state = state_of(observed);
  const auto k = static_cast<Eigen::Index>(trajectory_.times.size());
  trajectory_.times.push_back(state.t);
  trajectory_.q.col(k) = state.q;
  trajectory_.v.col(k) = state.v;
  Eigen::Index row = 0;
  for (const auto& quantity : quantities_)
    for (const double value : quantity.values(observed)) trajectory_.quantities(row++, k) = value;
}

std::array<int, 3> global_dofs(const FemModel& model, int node) {
  const FemModel::Parts& parts = model.parts();
  if (!parts.subdomain) return parts.dofs->node(node);
  std::array<double, 3> unknowns{-1, -1, -1};
  if (parts.subdomain->owns(node))
    for (std::size_t c = 0; c < 3; ++c)
      if (const int dof = parts.dofs->node(parts.subdomain->local(node))[c]; dof >= 0)
        unknowns[c] = parts.unknowns[static_cast<std::size_t>(dof)];
  parts.subdomain->ranks().max(unknowns);
  return {static_cast<int>(unknowns[0]), static_cast<int>(unknowns[1]), static_cast<int>(unknowns[2])};
}

Eigen::MatrixXd global_mass_product(const FemModel& model, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd out(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Vector part = model.part_of(x.col(k));
    Vector product(part.size());
    model.multiply_mass(part, product);
    out.col(k) = model.whole_of(product);
  }
  return out;
}

ProbeRecorder::ProbeRecorder(const Named<Probe>& probes, const Mesh& mesh, std::size_t outputs,
                             std::vector<Quantity> quantities)
    : TrajectoryRecorder(outputs, std::move(quantities)) {
  for (const auto& [name, probe] : probes) places_.push_back(mesh_point(mesh, probe.at));
}

State ProbeRecorder::state_of(const ObservedState& observed) const {
  return {observed.t(), at_probes(observed.evaluate("displacement")), at_probes(observed.evaluate("velocity"))};
}

Vector ProbeRecorder::at_probes(const std::vector<double>& nodal) const {
  Vector all = Vector::Zero(3 * static_cast<Eigen::Index>(places_.size()));
  Eigen::Index row = 0;
  for (const auto& place : places_) {
    for (const auto& [node, weight] : place.nodes)
      all.segment<3>(row) += weight * Eigen::Map<const Vec3>(nodal.data() + 3 * static_cast<std::ptrdiff_t>(node));
    row += 3;
  }
  return all;
}

}  // namespace orthodyn
