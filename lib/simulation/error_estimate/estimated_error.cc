#include "lib/simulation/error_estimate/estimated_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/core/errors.h"
#include "lib/fem/element_mesh.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/error_estimate/locking_check.h"
#include "lib/simulation/run/outcome.h"

namespace orthodyn {

namespace {

constexpr double kMaxFinerUnknowns = 120'000;
constexpr double kMaxShapeEntries = 5e6;  // of mode shapes in finer elements

// Calls `work`, which uses finer elements. Returns false if it fails, because a failed estimate must not fail the
// computation.
template <class Work>
bool try_finer_elements(const FemModel& model, double& cpu_seconds, const Work& work) {
  if (!allows_finer_elements(model)) return false;
  const double begin = cpu_seconds_now();
  bool done = false;
  try {
    work();
    done = true;
  } catch (const RunError&) {          // unstable state, or out of memory
  } catch (const RecoverableError&) {  // the finer elements have no forces there
  } catch (const ConfigError&) {       // a load or a support that the finer mesh does not allow
  }
  cpu_seconds = cpu_seconds_now() - begin;
  return done;
}

// shape^T M shape for each shape, with the consistent mass matrix M. It is less than 1, because the shapes have unit
// modal mass with the lumped one.
std::vector<double> consistent_masses(const FemModel::Parts& parts, const std::vector<NodalVector>& shapes) {
  const ElementMesh mesh(parts.mesh);
  std::vector<double> sums(shapes.size(), 0);
  for (std::size_t r = 0; r < parts.elastic.size(); ++r) {
    const double density = parts.densities[r] * parts.elastic[r]->definition().share;
    for (const int cell : parts.elastic[r]->definition().cells) {
      const auto c = static_cast<std::size_t>(cell);
      const Eigen::MatrixXd M = mesh.type(c).consistent_mass(mesh.positions(c), density);
      const auto nodes = mesh.cells[c];
      ElementType::Nodes at(3, M.cols());
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        for (std::size_t a = 0; a < nodes.size(); ++a) at.col(static_cast<Eigen::Index>(a)) = shapes[k].col(nodes[a]);
        sums[k] += (at * M).cwiseProduct(at).sum();
      }
    }
  }
  return sums;
}

// Relative error of each frequency, by recovered stresses. A shape of unit modal mass has the elastic energy omega^2/2,
// so that the error of this energy gives the error of omega^2. The error of a lumped mass is its difference from the
// consistent mass, whose own error is of higher order.
std::vector<double> recovered_frequency_errors(const FemModel& model, const State& state, const Modes& modes) {
  const FemModel::Parts& parts = model.parts();
  const NodalExpansion about(parts, state.t, state.q, state.v);
  std::vector<NodalVector> shapes;
  for (const Mode& mode : modes.modes) {
    shapes.push_back(NodalVector::Zero(3, about.x.cols()));
    parts.dofs->add_to(mode.shape, shapes.back());
  }
  const auto masses = parts.mass->lumped() ? consistent_masses(parts, shapes) : std::vector<double>(shapes.size(), 1.0);
  std::vector<double> errors(shapes.size(), 0);
  for (auto k = static_cast<std::size_t>(modes.zeros); k < errors.size(); ++k) {
    const StressMisfit misfit = parts.recovery->misfit_along(shapes[k], about.state());
    const double stiffness = parts.recovery->product(misfit, misfit) / std::abs(modes.modes[k].lambda);
    errors[k] = (stiffness - (1 - masses[k])) / 2;
  }
  return errors;
}

// A displacement along the first elastic mode, so small that the law is linear.
State along_a_shape(const FemModel& model, const State& about, const Modes& modes) {
  const auto first = std::min(static_cast<std::size_t>(modes.zeros), modes.modes.size() - 1);
  const Vector& shape = modes.modes[first].shape;
  const double extent = bounding_box(model.parts().mesh).size().minCoeff();
  return {about.t, about.q + 1e-6 * extent / std::max(shape.lpNorm<Eigen::Infinity>(), 1e-300) * shape, about.v};
}

std::string unit_of(const std::string& field, const FemModel& model) {
  const auto all = model.outputs();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OutputInfo& info) { return info.name == field; });
  return found == all.end() ? "" : found->unit;
}

// Probed nodes of each probed field. Displacement and velocity are left out, because they have their own estimate.
NodesByField probed_fields(const Scene& scene, const FemModel& model) {
  NodesByField out;
  for (const auto& [name, probe] : scene.output.probes)
    for (const std::string& field : probe.fields)
      if (field != "displacement" && field != "velocity") out[field].push_back(probe.node(model.parts().mesh));
  return out;
}

// Errors of probed fields in the order of the probes. Values that are not finite are left out.
std::vector<ProbedError> probed_errors(const Scene& scene, const FemModel& model, const StateError& found) {
  std::vector<ProbedError> out;
  std::map<std::string, std::size_t> next;
  for (const auto& [name, probe] : scene.output.probes)
    for (const std::string& field : probe.fields)
      if (const auto at = found.fields.find(field); at != found.fields.end()) {
        const auto [scale, error] = at->second[next[field]++];
        if (std::isfinite(scale) && std::isfinite(error))
          out.push_back({name, field, unit_of(field, model), scale, error});
      }
  return out;
}

}  // namespace

bool allows_finer_elements(const FemModel& model) {
  return !model.ranks() && model.parts().joints.empty() && model.pattern().symmetric &&
         FinerModel::estimated_unknowns(model) <= kMaxFinerUnknowns;
}

StateMeshError estimate_mesh_error(const Scene& scene, const FemModel& model, const State& state, bool in_motion,
                                   const MeshError& recovered, const std::vector<int>& nodes) {
  StateMeshError out{recovered};
  MeshError& error = out.error;
  // Finer elements have no history of internal variables.
  const bool is_relaxed = state.z.size() == 0;
  error.by_finer_elements = is_relaxed && try_finer_elements(model, error.cpu_seconds, [&] {
                              const StateError found = state_error(FinerModel(scene, model), state, in_motion, nodes,
                                                                   probed_fields(scene, model));
                              const double elastic = model.evaluate("energy.mesh_error", state)[1];
                              if (!std::isfinite(found.energy) || !(found.energy + elastic > 0))
                                throw RunError("the mesh error is not finite");
                              error.relative = found.energy / (found.energy + elastic);
                              error.samples = 1;
                              out.displacements = found.displacements;
                              error.probed = probed_errors(scene, model, found);
                            });
  error.locking_risk = locking_risk(model, state, error.by_finer_elements);
  error.probed_unknown = error.probed.empty() && !probed_fields(scene, model).empty();
  return out;
}

FrequencyErrors frequency_errors_of(const Scene& scene, const FemModel& model, const State& about, const Modes& modes) {
  FrequencyErrors out;
  out.by_finer_elements = try_finer_elements(model, out.cpu_seconds, [&] {
    if (FinerModel::estimated_unknowns(model) * static_cast<double>(modes.modes.size()) > kMaxShapeEntries)
      throw RunError("the shapes of the finer elements take too much memory");
    out.shares = frequency_errors(FinerModel(scene, model), about, modes);
    for (const double share : out.shares)
      if (!std::isfinite(share)) throw RunError("the error of a frequency is not finite");
  });
  if (!out.by_finer_elements) out.shares = recovered_frequency_errors(model, about, modes);
  if (!modes.modes.empty())
    out.locking_risk = locking_risk(model, along_a_shape(model, about, modes), out.by_finer_elements);
  return out;
}

std::string locking_warning(const std::string& locking_risk) {
  return locking_risk.empty() ? "" : "the mesh error may be larger than estimated: " + locking_risk;
}

std::string finer_mesh(int order) { return order == 1 ? "Use mesh.order: 2 or finer cells" : "Use finer cells"; }

std::string stress_warning(const MeshError& error, int order) {
  const auto is_coarse = [](const ProbedError& e) { return e.share() > kCoarseStress; };
  const auto count = std::count_if(error.probed.begin(), error.probed.end(), is_coarse);
  if (count == 0) return "";
  const auto worst = std::max_element(error.probed.begin(), error.probed.end(),
                                      [](const auto& a, const auto& b) { return a.share() < b.share(); });
  return fmt::format(
      "the mesh is coarse for {} of {} probed stresses or strains: {} of {} has an error of about {:.2g} % of its size "
      "there. {} there, and compare",
      count, error.probed.size(), worst->field, worst->probe, 100 * worst->share(), finer_mesh(order));
}

std::string frequency_warning(const FrequencyErrors& errors, int order) {
  const auto is_coarse = [](double share) { return std::abs(share) > kCoarseMesh; };
  const auto count = std::count_if(errors.shares.begin(), errors.shares.end(), is_coarse);
  if (count == 0) return "";
  const auto first = std::find_if(errors.shares.begin(), errors.shares.end(), is_coarse);
  const auto less = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto worst = std::max_element(errors.shares.begin(), errors.shares.end(), less);
  const auto in_words = [&](auto mode) {
    return fmt::format("mode {} about {:.2g} % too {}", mode - errors.shares.begin() + 1, 100 * std::abs(*mode),
                       *mode > 0 ? "high" : "low");
  };
  return fmt::format("the mesh is coarse for {} of {} frequencies: {}{}. {}, and compare", count, errors.shares.size(),
                     in_words(first), worst == first ? "" : ", " + in_words(worst), finer_mesh(order));
}

}  // namespace orthodyn
