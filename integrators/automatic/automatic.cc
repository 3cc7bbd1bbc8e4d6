// `auto`: looks at the model and the task, takes one of the other integrators and says why.
//
// It knows what comparisons have taught (docs/speed-against-error.md); a comparison of all methods on the scene
// itself is better founded: `orthodyn compare`.
#include <algorithm>

#include "integrators/automatic/outlook.h"
#include "integrators/error_control.h"
#include "integrators/linear_solver_key.h"

namespace orthodyn {
namespace {

struct AutomaticOptions : ErrorControl {
  std::string linear_solver = "cholmod";
  std::optional<std::string> method;
  std::string because;
  std::optional<double> safety;
};

// Does what the chosen integrator does, and tells of the choice.
class Automatic : public Integrator {
 public:
  Automatic(std::unique_ptr<Integrator> chosen, Advice advice, const Scales& scales)
      : chosen_(std::move(chosen)), advice_(std::move(advice)), scales_(scales) {}
  void start(const State& state) override { chosen_->start(state); }
  StepInfo step(double t_stop) override { return chosen_->step(t_stop); }
  void interpolate(double t, State& out) const override { chosen_->interpolate(t, out); }
  const Statistics& statistics() const override { return chosen_->statistics(); }
  std::size_t factor_bytes() const override { return chosen_->factor_bytes(); }
  std::size_t bytes() const override { return chosen_->bytes(); }
  Decisions decisions() const override {
    Decisions all{{"method", advice_.method}, {"because", advice_.because}};
    if (advice_.safety) all.emplace_back("safety", number_text(*advice_.safety));
    for (const auto& decision : scale_decisions(scales_)) all.push_back(decision);
    for (const auto& decision : chosen_->decisions())
      if (decision.first == "linear_solver") all.push_back(decision);
    return all;
  }

 private:
  std::unique_ptr<Integrator> chosen_;
  Advice advice_;
  Scales scales_;
};

bool has_key(const std::string& integrator, const std::string& name) {
  const auto& keys = Registry<IntegratorChoice>::entries().at(integrator).keys;
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
}

// The section of the chosen integrator, with those of our options that it has.
Config section_of(const Advice& advice, const AutomaticOptions& options) {
  const Config section = Config::from_text("{type: " + advice.method + "}", "integrator: auto");
  const auto hand_on = [&](const std::string& key, const std::string& value) {
    if (has_key(advice.method, key)) section.fill(key, value);
  };
  if (advice.safety) hand_on("safety", number_text(*advice.safety));
  hand_on("rtol", number_text(options.rtol));
  if (options.h0) hand_on("h0", number_text(*options.h0));
  if (options.h_max) hand_on("h_max", number_text(*options.h_max));
  hand_on("h_min", number_text(options.h_min));
  hand_on("max_steps", std::to_string(options.max_steps));
  hand_on("linear_solver", options.linear_solver);
  return section;
}

class AutomaticChoice : public IntegratorChoice, public AutomaticOptions {
 public:
  static const Spec<AutomaticChoice>& spec() {
    using C = AutomaticChoice;
    static const auto s =
        ErrorControl::spec_for<C>()
            .key("linear_solver", &C::linear_solver, "One of `orthodyn list solvers`, but for klu_full.")
            .key("method", &C::method, "The integrator; chosen by a look at the scene where it is left out.")
            .key("because", &C::because, "Why it was chosen, in words; written by the program.")
            .key("safety", &C::safety, "Of central_differences, if that is the method; written by the program.",
                 {.range = {0, 1, true, true}})
            .check([](const C& options, const Config& config) { options.check(config); });
    return s;
  }
  static MethodFacts facts() {
    return method_facts("that of the method it takes", "that of the method it takes", "what the method it takes does",
                        "docs/speed-against-error.md");
  }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    const Scales own = scales(task);
    // central_differences has no error control whose steps could be limited.
    const bool limits_steps = h0 || h_max || h_min > 0;
    const Advice advice = method ? Advice{*method, because, safety}
                                 : advise(look_at(model, task, own, linear_solver), rtol,
                                          limits_steps ? 0 : static_cast<double>(max_steps));
    Task same = task;
    same.scales = [own] { return own; };
    const auto choice = Registry<IntegratorChoice>::read(section_of(advice, *this));
    return std::make_unique<Automatic>(choice->make(model, same), advice, own);
  }

 private:
  void check(const Config& config) const {
    require_linear_solver(linear_solver, SolverPaths::reduced, config);
    if (!method) return;
    auto names = Registry<IntegratorChoice>::names();
    std::erase(names, "auto");
    if (std::find(names.begin(), names.end(), *method) != names.end()) return;
    const auto near = nearest_name(*method, names);
    config.at("method").fail("expected one of " + join(names) + ", found '" + *method + "'" +
                             (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
};

const bool registered = Registry<IntegratorChoice>::add<AutomaticChoice>(
    "auto", "Looks at the scene, takes one of the others and says why.");

}  // namespace
}  // namespace orthodyn
