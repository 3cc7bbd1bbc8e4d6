#include "lib/scene/fibre_laws.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/fem/added_laws/fibres.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

bool is_active(const Material& material) { return material.fibres() && material.fibres()->active; }

Eigen::Matrix3Xd centres(const ElementMesh& mesh, const std::vector<int>& cells) {
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t k = 0; k < cells.size(); ++k)
    all.col(static_cast<Eigen::Index>(k)) = mesh.positions(static_cast<std::size_t>(cells[k])).rowwise().mean();
  return all;
}

FibreActivation activation_of(const Scene& scene, const ElementType& type, const ElementMesh& mesh,
                              const std::vector<int>& cells, const std::vector<int>& of_all_ranks) {
  const Activation& section = *scene.activation;
  FibreActivation activation;
  activation.values = section.at_points(type, mesh, cells, of_all_ranks, scene.time.start, scene.time.end);
  activation.points_per_element = type.num_points();
  activation.refuse = [origin = section.origin, places = centres(mesh, cells)](double t, double value,
                                                                               Eigen::Index element) {
    const Vec3 x = places.col(std::min(element, places.cols() - 1));
    origin.fail(
        fmt::format("is {:.6g} at t = {:.6g} s in the element at ({:.4g}, {:.4g}, {:.4g}) m; it must stay "
                    "between 0 and 1",
                    value, t, x[0], x[1], x[2]));
  };
  return activation;
}

// Refuses activations outside of [0, 1] before the run where they are easily found.
void check_activation(const AddedLaw& law, const TimeSpan& time) {
  law.at(time.start);
  for (const double t : law.breakpoints(time.start, time.end)) law.at(t);
  law.at(time.end);
}

}  // namespace

std::vector<std::unique_ptr<const AddedLaw>> fibre_laws(const Scene& scene, const ElasticPart& part,
                                                        const ElementMesh& mesh, const std::vector<int>& cells) {
  std::vector<std::unique_ptr<const AddedLaw>> laws;
  const std::optional<Fibres>& fibres = part.material->fibres();
  if (!fibres) return laws;
  const Kinematics kinematics = elasticity_of(scene, *part.entry).kinematics;
  if (fibres->passive) laws.push_back(make_passive_fibres(*fibres->passive, kinematics));
  if (fibres->active) {
    laws.push_back(
        make_active_fibres(*fibres->active, kinematics, activation_of(scene, *part.type, mesh, cells, part.cells)));
    check_activation(*laws.back(), scene.time);
  }
  return laws;
}

void declare_fibres(const Scene& scene, const Material& material, Traits& traits) {
  if (!material.fibres()) return;
  traits.linear = false;
  if (!is_active(material)) return;
  if (!scene.activation->constant()) {
    traits.time_dependent = traits.loaded = true;
    traits.conservative = false;
  }
  if (material.fibres()->active->velocity) {
    traits.damping_matrix = traits.dissipative = true;
    traits.conservative = false;
  }
}

void check_fibres(const Config& config, const Scene& scene) {
  bool is_used = false;
  for (const auto& [name, material] : scene.materials) {
    if (scene.analysis == Analysis::buckling && material->fibres() && material->fibres()->passive)
      config.at("analysis")
          .fail(
              "buckling is linear about rest, where the stiffness of passive fibres jumps; follow the load path with "
              "analysis: static");
    if (!is_active(*material)) continue;
    is_used = true;
    if (!scene.activation)
      material->fibres()->active->origin.fail(
          "needs the scene's section 'activation', such as `activation: {value: 1, factor: {type: ramp, end: 0.1}}`");
  }
  if (scene.activation && !is_used)
    config.at("activation").fail("has no effect: no material has `fibres: {active: ...}`");
}

}  // namespace orthodyn
