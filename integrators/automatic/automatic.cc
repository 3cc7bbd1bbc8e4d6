// `auto`: chooses one of the other integrators for the model and the task, and reports the reason.
//
// The choice uses measured costs (cost_estimate.h, docs/speed-against-error.md); `orthodyn compare` measures all
// methods on the scene itself. A linear model gets `modal` if a trial run shows that few modes suffice (modal_plan.h).
#include <algorithm>

#include "integrators/automatic/modal_plan.h"
#include "integrators/error_control.h"
#include "integrators/solver_options.h"
#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

// Forwards to the chosen integrator and adds the choice to its decisions.
class Automatic : public Integrator {
 public:
  Automatic(std::unique_ptr<Integrator> integrator, MethodChoice choice, const Scales& scales)
      : integrator_(std::move(integrator)), choice_(std::move(choice)), scales_(scales) {}
  void start(const State& state) override { integrator_->start(state); }
  StepInfo step(double t_stop) override { return integrator_->step(t_stop); }
  void interpolate(double t, State& out) const override { integrator_->interpolate(t, out); }
  void interpolate_sensitivity(int i, double t, State& out) const override {
    integrator_->interpolate_sensitivity(i, t, out);
  }
  bool adaptive() const override { return integrator_->adaptive(); }
  bool has_accurate_interpolation() const override { return integrator_->has_accurate_interpolation(); }
  double smooth_time() const override { return integrator_->smooth_time(); }
  std::vector<std::string> result_warnings() const override { return integrator_->result_warnings(); }
  std::optional<State> mean_state() const override { return integrator_->mean_state(); }
  const Statistics& statistics() const override { return integrator_->statistics(); }
  std::size_t factor_bytes() const override { return integrator_->factor_bytes(); }
  std::size_t bytes() const override { return integrator_->bytes(); }
  Decisions decisions() const override {
    Decisions all{{"method", choice_.method}, {"because", choice_.rationale}};
    if (choice_.safety) all.emplace_back("safety", number_text(*choice_.safety));
    if (choice_.modes) all.emplace_back("modes", std::to_string(*choice_.modes));
    for (const auto& decision : scale_decisions(scales_)) all.push_back(decision);
    for (const auto& decision : integrator_->decisions())
      if (decision.first == "linear_solver" || decision.first == "kept") all.push_back(decision);
    return all;
  }

 private:
  std::unique_ptr<Integrator> integrator_;
  MethodChoice choice_;
  Scales scales_;
};

class AutomaticChoice : public SettableChoice<AutomaticChoice>, public ErrorControl {
 public:
  static const Spec<AutomaticChoice>& spec() {
    using C = AutomaticChoice;
    static const auto s = [] {
      auto spec = ErrorControl::spec_for<C>();
      return add_linear_solver(spec, SolverPaths::reduced)
          .key("method", &C::method, "The integrator; chosen for the scene by default.")
          .key("because", &C::rationale, "Reason for the choice; written by the program.")
          .key("safety", &C::safety, "Safety factor, if the method is central_differences; written by the program.",
               {.range = {0, 1, true, true}})
          .key("modes", &C::modes, "Number of modes kept, if the method is modal; written by the program.",
               {.range = {1}})
          .key("kept", &C::kept,
               "Modes kept and the share of the motion that they leave out, if the method is modal; written by the "
               "program.")
          .check([](const C& options, const Config& config) { options.check_method(config); });
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("that of the chosen method", "that of the chosen method", "what the chosen method conserves",
                        "docs/speed-against-error.md");
  }
  // On several ranks only methods that run there are chosen; a recorded `modal` is replaced.
  bool runs_on_ranks() const override {
    return !method || *method == "modal" || Registry<IntegratorChoice>::entries().at(*method).make()->runs_on_ranks();
  }
  bool computes_sensitivities() const override {
    return !method || Registry<IntegratorChoice>::entries().at(*method).make()->computes_sensitivities();
  }
  InternalSupport internal_support() const override { return InternalSupport::own; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    Scales own = scales(task);
    if (!method && own.omega == 0) own.omega = task.scales().omega;  // needed even if both scales are given
    const MethodChoice choice =
        is_settled(model) ? MethodChoice{*method, rationale, safety, modes} : choose(model, task, own);
    IntegratorSettings wanted = settings();
    wanted.position_scale = own.position;
    wanted.velocity_scale = own.velocity;
    wanted.safety = choice.safety;
    wanted.modes = choice.modes;
    const auto options = Registry<IntegratorChoice>::entries().at(choice.method).make()->with(wanted);
    return std::make_unique<Automatic>(options->make(model, task), choice, own);
  }

  SolverChoice linear_solver;
  std::optional<std::string> method;
  std::string rationale;
  std::optional<double> safety;
  std::optional<int> modes;
  std::string kept;

 private:
  // True if the recorded method is kept. `modal` is replaced if the model is no longer linear or is distributed over
  // ranks.
  bool is_settled(const Model& model) const { return method && (*method != "modal" || allows_modes(model)); }

  MethodChoice choose(const Model& model, const Task& task, const Scales& own) const {
    if (task.sensitivities) return {.method = "cvode_bdf", .rationale = "it integrates sensitivities with the motion"};
    if (model.constraints()) return method_with_constraints(model);
    if (model.internal_variables())
      return {.method = "cvode_bdf", .rationale = "it controls the error of viscoelastic strains"};
    // central_differences cannot limit its steps by h0, h_min and h_max.
    const bool limits_steps = h0 || h_max || h_min > 0;
    const CostEstimate cost = estimate_cost(model, task, own, linear_solver);
    MethodChoice stepping = choose_method(cost, rtol, limits_steps ? 0 : static_cast<double>(max_steps));
    if (auto modal = plan_modal(model, task, cost, *this, stepping)) return *std::move(modal);
    return stepping;
  }

  // At loose tolerances, ida_bdf damps the vibrations that would dominate the forces of joints.
  MethodChoice method_with_constraints(const Model& model) const {
    constexpr double kTight = 1e-5;
    if (rtol > kTight || model.internal_variables())
      return {.method = "ida_bdf", .rationale = "it solves the constraints of joints or rigid bodies"};
    return {.method = "generalized_alpha",
            .rationale = "it solves the constraints of joints or rigid bodies, and is the most accurate at this rtol"};
  }

  void check_method(const Config& config) const {
    if (modes && method != "modal")
      config.at("modes").fail("is used with `method: modal` only; remove it, or set integrator.type: modal");
    if (!method) return;
    auto names = Registry<IntegratorChoice>::names();
    std::erase(names, "auto");
    if (std::find(names.begin(), names.end(), *method) != names.end()) return;
    config.at("method").fail(expected_one_of(names, *method), InputFault::form);
  }
};

const bool automatic_registered = Registry<IntegratorChoice>::add<AutomaticChoice>(
    "auto", "Chooses one of the other methods for the scene and reports the reason.");

}  // namespace
}  // namespace orthodyn
