#include "lib/simulation/output/setup_file.h"

#include <fmt/format.h>

#include "lib/simulation/output/frames.h"

namespace orthodyn {

namespace {

std::vector<double> held(const DofMap& dofs) {
  std::vector<double> out;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int k = 0; k < 3; ++k) out.push_back(dofs.is_held(i, k) ? 1 : 0);
  return out;
}

std::vector<double> loads(const FemModel& model, const State& initial, double end) {
  const Vector still = Vector::Zero(model.num_dofs());  // zero velocities: no forces of dashpots
  const NodalExpansion nodal(model.parts(), initial.t, initial.q, still);
  NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
  for (const auto& term : model.parts().loads)
    if (term->energy_kind() == EnergyKind::none) term->add_peak_force(nodal.state(), end, sum);
  if (model.parts().subdomain) model.parts().subdomain->add_to_owners(sum);
  return {sum.data(), sum.data() + sum.size()};
}

// Gathers the fields of all ranks.
std::vector<double> whole(const FemModel& model, std::vector<double> values) {
  const auto& subdomain = model.parts().subdomain;
  return subdomain ? subdomain->whole_field(values, 3) : values;
}

}  // namespace

void SetupWriter::on_start(const ObservedState&) {
  const FemModel& model = *setup_.built.model;
  write_vtu(file_, model.geometry(),
            {{"held", Location::node, 3, whole(model, held(*model.parts().dofs))},
             {"load", Location::node, 3, whole(model, loads(model, setup_.built.initial, setup_.scene.time.end))}},
            &model.parts().mesh);
}

void write_axes(const std::filesystem::path& file, const FemModel& model) {
  const Vector zero = Vector::Zero(model.num_dofs());
  const State rest{0, zero, zero};
  std::vector<VtuField> fields;
  for (const int axis : {1, 2, 3})
    fields.push_back(
        {fmt::format("axis_{}", axis), Location::cell, 3, model.evaluate(fmt::format("material_axis_{}", axis), rest)});
  fields.push_back({"region", Location::cell, 1, model.evaluate("region", rest)});
  write_vtu(file, model.geometry(), fields, &model.parts().mesh);
}

}  // namespace orthodyn
