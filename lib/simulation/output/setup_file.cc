#include "lib/simulation/output/setup_file.h"

#include "lib/fem/whole_fields.h"
#include "lib/simulation/output/frames.h"

namespace orthodyn {

namespace {

std::vector<double> held(const DofMap& dofs) {
  std::vector<double> out;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (const int dof : dofs.node(i)) out.push_back(dof < 0 ? 1 : 0);
  return out;
}

std::vector<double> loads(const FemModel& model, const State& initial, double end) {
  const Vector still = Vector::Zero(model.num_dofs());  // dashpots are silent
  const NodalExpansion nodal(model.parts(), initial.t, initial.q, still);
  NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
  for (const auto& term : model.parts().loads)
    if (term->energy_kind() == EnergyKind::none) term->add_peak_force(nodal.state(), end, sum);
  if (model.parts().subdomain) model.parts().subdomain->add_to_owners(sum);
  return {sum.data(), sum.data() + sum.size()};
}

// Of the whole mesh, from this rank's part of it.
std::vector<double> whole(const FemModel& model, std::vector<double> values) {
  const auto& subdomain = model.parts().subdomain;
  return subdomain ? on_all_nodes(*subdomain, values, 3, model.parts().mesh.nodes.size()) : values;
}

}  // namespace

void SetupWriter::on_start(const ObservedState&) {
  const FemModel& model = *setup_.built.model;
  write_vtu(file_, model.geometry(),
            {{"held", Location::node, 3, whole(model, held(*model.parts().dofs))},
             {"load", Location::node, 3, whole(model, loads(model, setup_.built.initial, setup_.scene.time.end))}},
            &model.parts().mesh);
}

}  // namespace orthodyn
