#include "lib/simulation/preflight/scene_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "lib/analysis/static_response.h"
#include "lib/fem/part_model.h"
#include "lib/simulation/error_estimate/mesh_error.h"

namespace orthodyn {

namespace {

constexpr double kUsualAccuracy = 1e-3;    // without an rtol
constexpr double kOfAccuracy = 0.1;        // what is smaller than this part of it does not matter
constexpr double kSmall = 1e-6;            // of the smallest extent
constexpr int kLargestSystem = 30'000;     // unknowns of which two more models and a factor are made
constexpr double kSecondsOfVariant = 0.2;  // in which the cost of another model is measured
constexpr double kMuchData = 1e9;          // bytes of frames

double seconds_of(double budget, const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  work();  // caches, pages of memory and the processor's clock
  const auto begin = Clock::now();
  for (int count = 1;; ++count) {
    work();
    const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
    if (spent >= budget || count == 1000) return spent / count;
  }
}

class Judge {
 public:
  Judge(const Setup& setup, const std::vector<TermCost>& costs)
      : setup_(setup),
        model_(*setup.built.model),
        costs_(costs),
        accuracy_(accuracy_asked_for(setup.scene)),
        response_(static_response(model_, setup.built.initial, setup.scene.time.end)) {}

  std::vector<std::string> sentences() {
    if (response_.exists() && response_.work > 0) {
      look_at_loads();
      look_at_damping();
      look_at_regions();
      look_at_mesh();
      look_at_kinematics();
    }
    look_at_frames();
    return std::move(found_);
  }

 private:
  const FemModel::Parts& parts() const { return model_.parts(); }
  double threshold() const { return kOfAccuracy * accuracy_; }

  // The response, so small that rotations do not matter: the linear response of a slender body may be a large one.
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

  // What another model of the scene takes less of, measured as the costs were.
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

  // By what each would do alone: a force that holds a body up does no work on the response to all.
  void look_at_loads() {
    const auto loads = peak_loads(model_, setup_.built.initial, setup_.scene.time.end);
    if (loads.size() < 2) return;
    const auto alone = static_displacements(model_, loads);
    const auto names = part_names(parts());
    const double all = response_.displacement.lpNorm<Eigen::Infinity>();
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (loads[k].isZero(0) || alone[k].size() == 0) continue;  // springs, contact: nothing at rest
      const double share = alone[k].lpNorm<Eigen::Infinity>() / all;
      if (!(share < threshold())) continue;
      const std::string& name = names[parts().elastic.size() + k];
      found_.push_back(
          fmt::format("{}: alone it moves the body by {:.1e} of what all loads do; leaving it out saves {:.1g} % of a "
                      "force",
                      name, share, 100 * share_of_force(name)));
    }
  }

  // Of the slowest vibration, by Rayleigh's quotient of the response.
  void look_at_damping() {
    if (!setup_.scene.damping || setup_.scene.is_static()) return;
    const Vector& u = response_.displacement;
    Vector Mu(u.size());
    model_.multiply_mass(u, Mu);
    const double omega2 = response_.work / u.dot(Mu), time = setup_.scene.time.end - setup_.scene.time.start;
    const auto& damping = *setup_.scene.damping;
    const double taken = 0.5 * (damping.mass + damping.stiffness * omega2) * time;
    if (!(taken < accuracy_)) return;
    Scene without = setup_.scene;
    without.damping.reset();
    for (auto& [name, region] : without.regions) region.stiffness_damping.reset();
    const BuiltScene built = build(without);
    found_.push_back(
        fmt::format("damping: it takes {:.1e} of a slow vibration ({:.3g} Hz) in the time simulated, but "
                    "does take fast ones; leaving it out {}",
                    taken, std::sqrt(omega2) / (2 * std::numbers::pi), saving(*built.model, built.initial)));
  }

  // In the response, in which a region may move and hardly be strained.
  void look_at_regions() {
    if (parts().elastic.size() < 2) return;
    const Vector still = Vector::Zero(model_.num_dofs());
    const NodalExpansion nodal(parts(), setup_.built.initial.t, small_response(), still);
    std::vector<double> energies;
    double all = 0;
    for (const auto& term : parts().elastic) all += energies.emplace_back(term->energy(nodal.state()));
    for (std::size_t k = 0; k < energies.size(); ++k)
      if (energies[k] < threshold() * all)
        found_.push_back(
            fmt::format("region {}: it bears {:.1e} of the elastic energy and moves as a rigid body: {} "
                        "elements of it, {:.0f} % of a force, could be fewer",
                        parts().elastic[k]->region(), energies[k] / all, parts().elastic[k]->size(),
                        100 * share_of_force(parts().elastic[k]->name())));
  }

  void look_at_mesh() {
    const State state{setup_.built.initial.t, small_response(), Vector::Zero(model_.num_dofs())};
    const auto energy = model_.evaluate("energy.mesh_error", state);
    const double error = energy[0] / (energy[0] + energy[1]);
    if (error < threshold())
      found_.push_back(fmt::format(
          "mesh: its error is about {:.1e}: so fewer cells would do, or a smaller rtol would pay; doubling the "
          "cell size removes seven of eight elements",
          error));
    if (error > kCoarseMesh)
      found_.push_back(
          fmt::format("nothing of the mesh, whose error is about {:.1e} of the elastic energy: finer cells{} would "
                      "reduce it",
                      error, parts().mesh.order() == 1 ? " or mesh.order: 2" : ""));
  }

  void look_at_kinematics() {
    if (model_.traits().linear || setup_.scene.elasticity.is_warped() || setup_.kinematics ||
        model_.num_dofs() > kLargestSystem)
      return;
    Config config = setup_.config.copy().resolving();
    config.set("elasticity.kinematics", std::string("auto"));
    Scene scene = read_scene(config);
    if (!leaves_kinematics_open(scene)) return;
    if (const ChosenKinematics chosen = choose_kinematics(config, scene); chosen.choice.linear)
      found_.push_back(
          fmt::format("large rotations: by the linear response linear kinematics are off by less than "
                      "{:.1g} of the motion; elasticity.kinematics: auto takes them, and watches; this {}",
                      3 * chosen.watch->allowed(), saving(*chosen.built.model, chosen.built.initial)));
  }

  void look_at_frames() {
    const auto& output = setup_.scene.output;
    const double frames = output.interval ? (setup_.scene.time.end - setup_.scene.time.start) / *output.interval
                                          : output.frames.value_or(50);
    double numbers = 0;
    for (const auto& info : model_.outputs())
      for (const auto& field : output.fields)
        if (info.name == field)
          numbers += info.components * static_cast<double>(info.location == Location::node ? parts().mesh.nodes.size()
                                                                                           : parts().mesh.tets.size());
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

double accuracy_asked_for(const Scene& scene) {
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

std::vector<std::string> dispensable(const Setup& setup, const std::vector<TermCost>& costs) {
  return Judge(setup, costs).sentences();
}

}  // namespace orthodyn
