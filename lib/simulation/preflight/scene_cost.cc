#include "lib/simulation/preflight/scene_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "lib/analysis/static_response.h"
#include "lib/fem/fem_model.h"
#include "lib/simulation/error_estimate/mass_norm.h"
#include "lib/simulation/error_estimate/mesh_error.h"

namespace orthodyn {

namespace {

constexpr double kUsualAccuracy = 1e-3;    // if the integrator has no rtol
constexpr double kNegligible = 0.1;        // relative to the accuracy; smaller effects are negligible
constexpr double kSmall = 1e-6;            // displacement over the smallest extent
constexpr int kLargestSystem = 30'000;     // unknowns up to which further models and a factorisation are made
constexpr double kSecondsOfVariant = 0.2;  // for measuring another model
constexpr double kMuchData = 1e9;          // bytes of frames

double seconds_of(double budget, const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  work();  // warms up caches, memory pages and the clock rate
  const auto begin = Clock::now();
  for (int count = 1;; ++count) {
    work();
    const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
    if (spent >= budget || count == 1000) return spent / count;
  }
}

class SavingsFinder {
 public:
  SavingsFinder(const Setup& setup, const std::vector<TermCost>& costs)
      : setup_(setup),
        model_(*setup.built.model),
        costs_(costs),
        accuracy_(requested_accuracy(setup.scene)),
        response_(static_response(model_, setup.built.initial, setup.scene.time.end)) {}

  std::vector<std::string> sentences() {
    if (response_.exists() && response_.work > 0) {
      check_loads();
      check_damping_effect();
      check_regions();
      check_mesh();
      check_kinematics();
    }
    check_frames();
    return std::move(found_);
  }

 private:
  const FemModel::Parts& parts() const { return model_.parts(); }
  double threshold() const { return kNegligible * accuracy_; }

  // The response, scaled down until rotations are negligible, because the linear response of a slender body may be
  // large.
  Vector small_response() const {
    const Vector& u = response_.displacement;
    return kSmall * bounding_box(parts().mesh).size().minCoeff() / u.lpNorm<Eigen::Infinity>() * u;
  }

  double share_of_force(const std::string& name) const {
    double all = 0, own = 0;
    for (const TermCost& cost : costs_) {
      all += cost.force;
      if (cost.name == name) own = cost.force;
    }
    return all > 0 ? own / all : 0;
  }

  // The saving by another model of the scene, whose costs are measured in the same way.
  std::string saving(const FemModel& other, const State& initial) const {
    const auto sums = [](const std::vector<TermCost>& costs) {
      TermCost sum;
      for (const TermCost& cost : costs) sum.force += cost.force, sum.tangent += cost.tangent;
      return sum;
    };
    const TermCost now = sums(costs_), then = sums(term_costs(other, initial, kSecondsOfVariant));
    const auto less = [](double before, double after) { return 100 * std::max(1 - after / before, 0.0); };
    return fmt::format("saves about {:.0f} % of a force and {:.0f} % of a tangent", less(now.force, then.force),
                       less(now.tangent, then.tangent));
  }

  // Loads are judged by the response to each of them alone, because a supporting force does no work on the response to
  // all loads.
  void check_loads() {
    const auto loads = peak_loads(model_, setup_.built.initial, setup_.scene.time.end);
    if (loads.size() < 2) return;
    const auto alone = static_displacements(model_, loads);
    const auto names = part_names(parts());
    const double all = response_.displacement.lpNorm<Eigen::Infinity>();
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (loads[k].isZero(0) || alone[k].size() == 0) continue;  // springs: no force at rest
      if (parts().loads[k]->contact()) continue;                 // its force at rest tells nothing
      const double share = alone[k].lpNorm<Eigen::Infinity>() / all;
      if (!(share < threshold())) continue;
      const std::string& name = names[parts().elastic.size() + k];
      found_.push_back(fmt::format(
          "{}: alone it causes {:.1e} of the displacement by all loads; omitting it saves {:.1g} % of a force", name,
          share, 100 * share_of_force(name)));
    }
  }

  // Damping is judged by its effect on the slowest vibration, whose frequency is the Rayleigh quotient of the response.
  void check_damping_effect() {
    if (!setup_.scene.damping || setup_.scene.is_static()) return;
    const Vector& u = response_.displacement;
    const double omega2 = response_.work / mass_product(model_, u),
                 time = setup_.scene.time.end - setup_.scene.time.start;
    const auto& damping = *setup_.scene.damping;
    const double taken = 0.5 * (damping.mass + damping.stiffness * omega2) * time;
    if (!(taken < accuracy_)) return;
    Scene without = setup_.scene;
    without.damping.reset();
    for (auto& [name, region] : without.regions) region.stiffness_damping.reset();
    const BuiltScene built = build(without);
    found_.push_back(fmt::format(
        "damping: it reduces a slow vibration ({:.3g} Hz) by only {:.1e} of its amplitude in the simulated time, "
        "but it damps fast ones; omitting it {}",
        std::sqrt(omega2) / (2 * std::numbers::pi), taken, saving(*built.model, built.initial)));
  }

  // Regions are judged by their elastic energy in the response, because a region may move but hardly deform.
  void check_regions() {
    if (parts().elastic.size() < 2) return;
    const Vector still = Vector::Zero(model_.num_dofs());
    const NodalExpansion nodal(parts(), setup_.built.initial.t, small_response(), still);
    struct Region {
      double energy = 0, share_of_force = 0;
      int elements = 0;
    };
    std::map<std::string, Region> regions;  // with all their plies
    double all = 0;
    for (const auto& term : parts().elastic) {
      Region& region = regions[term->definition().mesh_region];
      const double energy = term->energy(nodal.state());
      region.energy += energy;
      all += energy;
      region.share_of_force += share_of_force(term->name());
      region.elements = std::max(region.elements, term->size());
    }
    for (const auto& [name, region] : regions)
      if (region.energy < threshold() * all)
        found_.push_back(
            fmt::format("region {}: it has {:.1e} of the elastic energy and moves as a rigid body: a coarser mesh "
                        "would do ({} elements, {:.0f} % of a force)",
                        name, region.energy / all, region.elements, 100 * region.share_of_force));
  }

  void check_mesh() {
    const State state{setup_.built.initial.t, small_response(), Vector::Zero(model_.num_dofs())};
    const auto energy = model_.evaluate("energy.mesh_error", state);
    const double error = energy[0] / (energy[0] + energy[1]);
    if (error < threshold())
      found_.push_back(
          fmt::format("mesh: its error is about {:.1e}: fewer cells would do, or a smaller rtol would be useful; "
                      "doubling the cell size removes seven of eight elements",
                      error));
    if (error > kCoarseMesh)
      found_.push_back(
          fmt::format("mesh: leave out no elements; its error is about {:.1e} of the elastic energy, and finer cells{} "
                      "would reduce it",
                      error, parts().mesh.order() == 1 ? " or mesh.order: 2" : ""));
  }

  void check_kinematics() {
    if (model_.traits().linear || setup_.scene.elasticity.is_warped() || setup_.kinematics ||
        model_.num_dofs() > kLargestSystem)
      return;
    Config config = setup_.config.copy().resolving();
    config.set("elasticity.kinematics", std::string("auto"));
    Scene scene = read_scene(config);
    if (!leaves_kinematics_open(scene)) return;
    if (const ChosenKinematics chosen = choose_kinematics(config, scene); chosen.choice.linear)
      found_.push_back(
          fmt::format("large rotations: by the linear response, linear kinematics are off by less than {:.1g} of the "
                      "motion; elasticity.kinematics: auto uses and monitors them; this {}",
                      3 * chosen.watch->allowed(), saving(*chosen.built.model, chosen.built.initial)));
  }

  void check_frames() {
    const auto& output = setup_.scene.output;
    const double frames = output.interval ? (setup_.scene.time.end - setup_.scene.time.start) / *output.interval
                                          : output.frames.value_or(50);
    double numbers = 0;
    for (const auto& info : model_.outputs())
      for (const auto& field : output.fields)
        if (info.name == field)
          numbers += info.components * static_cast<double>(info.location == Location::node ? parts().mesh.nodes.size()
                                                                                           : parts().mesh.cells.size());
    if (const double bytes = 4 * numbers * frames; bytes > kMuchData)
      found_.push_back(fmt::format("frames: {:.2g} GB; fewer output.frames or output.fields", bytes / 1e9));
  }

  const Setup& setup_;
  const FemModel& model_;
  const std::vector<TermCost>& costs_;
  double accuracy_;
  StaticResponse response_;
  std::vector<std::string> found_;
};

}  // namespace

double requested_accuracy(const Scene& scene) {
  if (scene.integrator)
    if (const auto rtol = scene.integrator->settings().rtol) return *rtol;
  return kUsualAccuracy;
}

std::vector<TermCost> term_costs(const FemModel& model, const State& initial, double seconds) {
  const auto& parts = model.parts();
  const NodalExpansion nodal(parts, initial.t, initial.q, initial.v);
  std::vector<const Term*> terms;
  for (const auto& term : parts.elastic) terms.push_back(term.get());
  for (const auto& term : parts.loads) terms.push_back(term.get());
  const auto names = part_names(parts);
  std::vector<double> K(model.pattern().row.size()), D(parts.traits.damping_matrix ? K.size() : 0);
  NodalVector f = NodalVector::Zero(3, nodal.x.cols());
  const double each = seconds / (2 * static_cast<double>(terms.size()));
  std::vector<TermCost> costs;
  for (std::size_t k = 0; k < terms.size(); ++k)
    costs.push_back({names[k], seconds_of(each, [&] { terms[k]->add_force(nodal.state(), f); }), seconds_of(each, [&] {
                       terms[k]->add_tangent(nodal.state(), TangentKind::exact, K.data(),
                                             D.empty() ? nullptr : D.data());
                     })});
  return costs;
}

std::vector<std::string> possible_savings(const Setup& setup, const std::vector<TermCost>& costs) {
  return SavingsFinder(setup, costs).sentences();
}

}  // namespace orthodyn
