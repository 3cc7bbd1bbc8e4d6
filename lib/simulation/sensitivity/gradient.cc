#include "lib/simulation/sensitivity/gradient.h"

#include <fmt/format.h>

#include <atomic>
#include <memory>

#include "lib/core/errors.h"
#include "lib/ode/adjoint_equations.h"
#include "lib/scene/build.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/sensitivity/gradient_quantity.h"
#include "lib/simulation/sensitivity/parameter_products.h"
#include "lib/simulation/sensitivity/stiffness_cell.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

using Progress = std::function<void(const GradientProgress&)>;

// Reports each equilibrium.
class EquilibriumProgress : public Observer {
 public:
  explicit EquilibriumProgress(const Progress& progress) : progress_(progress) {}
  void on_output(const ObservedState& observed) override {
    if (progress_) progress_({GradientProgress::Stage::equilibrium, observed.t(), observed.t()});
  }

 private:
  const Progress& progress_;
};

std::vector<SceneParameter> parameters_at(const Config& config, const std::vector<std::string>& paths) {
  std::vector<std::string> all;
  for (const std::string& path : paths) {
    const Config value = value_at(config, path);
    if (!value.is_map() || !value.has("grid")) {
      all.push_back(path);
      continue;
    }
    if (!value.has("values")) value.fail("factors from a file are no parameters; give them as 'values'");
    for (std::size_t k = 0; k < value.at("values").size(); ++k) all.push_back(fmt::format("{}.values.{}", path, k));
  }
  if (all.empty()) throw ConfigError("gradient", "name at least one number of the scene (--by PATH)");
  return model_parameters(config, all, {"parameters"});
}

// Numbers of a stiffness factor's cell along x, y and z, from 1; zeros for another parameter.
std::array<int, 3> cell_of(const std::string& path, const Scene& scene) {
  for (const auto& [name, region] : scene.regions) {
    const std::string begin = "regions." + name + ".stiffness_factors.values.";
    if (!region.stiffness_factors || !StiffnessCell::is_path(path) || !path.starts_with(begin)) continue;
    const std::array<int, 3>& grid = region.stiffness_factors->grid;
    const int cell = std::stoi(path.substr(begin.size()));
    return {cell % grid[0] + 1, cell / grid[0] % grid[1] + 1, cell / (grid[0] * grid[1]) + 1};
  }
  return {};
}

// G = the quantity at one time.
class Equations final : public AdjointEquations {
 public:
  // All arguments must outlive this object.
  Equations(const GradientQuantity& quantity, double start, double end, ParameterProducts& products,
            const std::vector<SceneParameter>& parameters, const Progress& progress)
      : quantity_(quantity),
        start_(start),
        times_{end},
        products_(products),
        parameters_(parameters),
        progress_(progress) {}

  const std::vector<double>& times() const override { return times_; }
  void source(std::size_t, const State& state, VectorRef by_position, VectorRef by_velocity) override {
    quantity_.derivatives(state, by_position, by_velocity);
    at_time = state;
  }
  int count() const override { return products_.count(); }
  // 10 % of the parameter; 10 degrees of an angle.
  double scale(int i) const override { return 10 * parameters_[static_cast<std::size_t>(i)].usual_change(); }
  std::optional<double> size() const override { return quantity_.size(at_time); }
  void products(const State& state, const ConstVectorRef& b, VectorRef out) override {
    products_.compute(state, b, out);
    report(GradientProgress::Stage::adjoint, state.t);
  }
  void on_forward_step(double t) override { report(GradientProgress::Stage::motion, t); }

  State at_time;  // set by source()

 private:
  void report(GradientProgress::Stage stage, double t) const {
    const double share = (t - start_) / (times_.front() - start_);
    if (progress_) progress_({stage, t, stage == GradientProgress::Stage::motion ? share : 1 - share});
  }

  const GradientQuantity& quantity_;
  double start_;
  std::vector<double> times_;
  ParameterProducts& products_;
  const std::vector<SceneParameter>& parameters_;
  const Progress& progress_;
};

void require_adjoint(const Setup& setup) {
  const Traits& traits = setup.built.model->traits();
  const Scene& scene = setup.scene;
  const auto fail = [](const std::string& reason) { throw ConfigError("gradient", reason); };
  if (setup.built.model->constraints())
    fail("adjoint equations are not available with joints or free rigid bodies: compute differences between runs");
  if (!scene.is_static() && setup.built.model->internal_variables())
    fail("adjoint equations of motions are not available with viscoelastic materials");
  if (!traits.smooth) fail("the scene has contact or stops, whose force has kinks: compute differences between runs");
  if (!traits.exact_stiffness || has_unsymmetric_load(scene, setup.built.model->parts().mesh))
    fail("the stiffness is unsymmetric (a load that follows the body, or corotation: warped): use sensitivities");
  if (!scene.is_static() && traits.damping_matrix && !traits.linear)
    fail(
        "with stiffness-proportional damping, a body that turns has an unsymmetric tangent: use sensitivities, "
        "mass-proportional damping, or elasticity.kinematics: linear");
}

Gradient of_equilibrium(const Setup& setup, const GradientQuantity& quantity, ParameterProducts& products,
                        const Progress& progress, State& state) {
  const StaticProblem problem = static_problem(setup.scene, setup.built);
  const std::atomic<bool> never{false};
  EquilibriumProgress observer(progress);
  const Outcome outcome = run_static(*problem.path, *problem.stepper, {&observer}, never);
  if (outcome.status != Outcome::Status::completed) throw RunError("no equilibrium was found: " + outcome.message);
  state = {problem.path->times().end, outcome.last.q, Vector::Zero(outcome.last.q.size())};
  constexpr double kAllLoads = 1;
  Linearization tangent;
  problem.path->linearize(kAllLoads, state.q, Vector::Zero(state.q.size()), TangentKind::exact, tangent);
  std::vector<double> values(problem.path->pattern().row.size());
  problem.path->combine({0, 0, 1}, tangent, values.data());
  const auto factor = make_indefinite_solver(problem.path->pattern());
  if (factor->factor(values.data()) != FactorStatus::ok)
    throw RunError("the stiffness at the equilibrium is singular, so the derivatives do not exist");
  Vector slope(state.q.size()), of_velocity(state.q.size()), adjoint(state.q.size()), out(products.count());
  quantity.derivatives(state, slope, of_velocity);
  factor->solve(slope, adjoint);
  products.compute(state, adjoint, out);
  Gradient found;
  found.derivatives.assign(out.begin(), out.end());
  return found;
}

// K^-1 a at the equilibrium from which a motion starts.
Vector adjoint_of_equilibrium(const Setup& setup, const Vector& a) {
  const FemModel& model = *setup.built.model;
  const State& start = setup.built.initial;
  Linearization tangent;
  model.linearize(start.t, start.q, Vector::Zero(start.q.size()), TangentKind::exact, tangent);
  std::vector<double> values(model.pattern().row.size());
  model.combine({0, 0, 1}, tangent, values.data());
  const auto factor = make_indefinite_solver(model.pattern());
  if (factor->factor(values.data()) != FactorStatus::ok)
    throw RunError("start: equilibrium: the stiffness is singular, so that the derivatives do not exist");
  Vector out(a.size());
  factor->solve(a, out);
  return out;
}

Gradient of_motion(const Setup& setup, const GradientQuantity& quantity, double t, ParameterProducts& products,
                   const std::vector<SceneParameter>& parameters, const Progress& progress, State& state) {
  const auto* method = dynamic_cast<const AdjointIntegrator*>(setup.scene.integrator.get());
  if (!method)
    throw ConfigError("gradient", "adjoint equations are integrated by cvode_bdf: set integrator.type to it");
  if (setup.scene.start == Start::equilibrium && (setup.scene.initial || !setup.scene.motions.empty()))
    throw ConfigError("start",
                      "equilibrium with 'initial' or 'motions' is not available for gradients: use sensitivities");
  const Task task = task_of(setup.scene, setup.built);
  Equations equations(quantity, task.initial.t, t, products, parameters, progress);
  const AdjointSolution solution = method->integrate_adjoint(*setup.built.model, task, equations);
  Gradient found;
  state = equations.at_time;
  if (setup.scene.start == Start::equilibrium) {
    const State& start = setup.built.initial;
    Vector at_start(products.count());
    products.compute(start, adjoint_of_equilibrium(setup, solution.a), at_start);
    const Vector sum = solution.integral + at_start;
    found.derivatives.assign(sum.begin(), sum.end());
  } else
    for (int i = 0; i < products.count(); ++i) {
      const State start = products.initial_derivative(i);
      found.derivatives.push_back(solution.integral[i] + solution.a.dot(start.q) + solution.momentum.dot(start.v));
    }
  found.forward_steps = solution.forward_steps, found.backward_steps = solution.backward_steps;
  found.adjoint_rtol = solution.rtol;
  return found;
}

}  // namespace

Gradient gradient(const Config& config, const GradientRequest& request) {
  const Setup setup = set_up(config);
  require_adjoint(setup);
  const Scene& scene = setup.scene;
  const GradientQuantity quantity(request.quantity, scene, *setup.built.model);
  if (scene.is_static() && request.at) throw ConfigError("gradient", "the scene is static: leave out the time");
  const double t = request.at.value_or(scene.time.end);
  if (!scene.is_static() && !(t > scene.time.start && t <= scene.time.end))
    throw ConfigError("gradient", fmt::format("the time {} s is outside of the time span, {} to {} s", t,
                                              scene.time.start, scene.time.end));
  const Config chosen = with_chosen_kinematics(setup.config);
  const auto parameters = parameters_at(chosen, request.paths);
  ParameterProducts products(chosen, scene, setup.built, parameters);
  State state;
  Gradient found = scene.is_static() ? of_equilibrium(setup, quantity, products, request.on_progress, state)
                                     : of_motion(setup, quantity, t, products, parameters, request.on_progress, state);
  const ChangedMotion motion = scene.is_static() ? ChangedMotion::still : ChangedMotion::as_given;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    found.derivatives[i] += quantity.explicit_derivative(chosen, parameters[i], state, motion);
  found.value = quantity.value(state);
  found.unit = quantity.unit();
  found.parameters = parameters;
  for (const SceneParameter& parameter : parameters) found.cells.push_back(cell_of(parameter.path(), scene));
  if (!scene.is_static()) found.rtol = scene.integrator->settings().rtol;
  return found;
}

}  // namespace orthodyn
