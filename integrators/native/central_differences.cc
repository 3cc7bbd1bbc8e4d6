// Central differences as kick-drift-kick leapfrog: explicit, order 2, one force per step.
//
//   q1 = q + h v + h^2/2 a,   a1 = M^-1 f(t + h, q1, v + h a),   v1 = v + h/2 (a + a1).
//
// A velocity-dependent force is evaluated at the predicted velocity v + h a. This keeps order 2 without a matrix but
// lowers the stability limit (critical_step.h), so damping costs steps. Without damping the map is symplectic and the
// energy stays bounded. A consistent mass costs one solve per step. Constraints: rattle.h. Sources: Newmark 1959 (beta
// = 0); Verlet 1967; Hughes 1987, 9.1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "integrators/critical_step.h"
#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/native/explicit_step.h"
#include "integrators/native/rattle.h"
#include "lib/config/values.h"

namespace orthodyn {
namespace {

// Longest side of the model's bounding box, m; infinite if the model has no points.
double extent(const Model& model) {
  const auto points = model.geometry().points;
  if (points.empty()) return std::numeric_limits<double>::infinity();
  Vec3 low = points[0], high = points[0];
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).maxCoeff();
}

// Monitors the critical step while the stiffness changes.
//
// The critical step is recomputed (one tangent and a few matrix products) after an interval of steps. The interval
// grows by half if the critical step has changed by less than 0.5 % and is halved if it has changed by more than 2 %. A
// constant stiffness is evaluated once. Not thread-safe: one object per integrator.
class CriticalStepMonitor {
 public:
  // Both arguments must outlive this object.
  CriticalStepMonitor(const Model& model, Statistics& statistics)
      : constant_(model.traits().linear), critical_step_(model, statistics) {}

  // Recomputes the critical step at a state. Throws the model's RecoverableError.
  void update(const State& state) {
    if (constant_ && step_ > 0) return;
    const double before = step_;
    step_ = critical_step_.at(state);
    if (interval_ == 0) interval_ = kFirstInterval;
    else if (const double change = std::abs(step_ / before - 1); change > kLargeChange) interval_ /= 2;
    else if (change < kSmallChange) interval_ += interval_ / 2;
    left_ = interval_ = std::clamp(interval_, kShortestInterval, kLongestInterval);
  }

  // Counts a step. True if update() is due.
  bool due() { return !constant_ && --left_ <= 0; }

  // Critical step (s) at the last update; infinite without stiffness and damping.
  double critical() const { return step_; }
  bool expects_contact() const { return critical_step_.reserve() > 0; }

 private:
  static constexpr int kFirstInterval = 50, kShortestInterval = 20, kLongestInterval = 800;
  static constexpr double kSmallChange = 0.005, kLargeChange = 0.02;

  bool constant_;
  CriticalStep critical_step_;
  double step_ = 0;
  int interval_ = 0, left_ = 0;  // steps
};

struct CentralOptions {
  AutoOr<double> step;  // s
  double safety = 0.9;
  long max_steps = 10'000'000;
};

class CentralDifferences : public ExplicitStep {
 public:
  CentralDifferences(const Model& model, const Task& task, const CentralOptions& options)
      : ExplicitStep(model, remedies(options), 2, options.max_steps),
        options_(options),
        monitor_(model, statistics_),
        unbounded_(task.output_interval > 0 ? task.output_interval : task.end - task.initial.t),
        extent_(extent(model)) {
    if (model.constraints()) rattle_.emplace(model, std::isfinite(extent_) ? extent_ : 0);
    check_start(task);
    choose_step();
  }

  std::size_t bytes() const override {
    const auto n = static_cast<std::size_t>(model_.num_dofs());
    return (10 * n + 3 * model_.pattern().row.size()) * sizeof(double) + (rattle_ ? rattle_->bytes() : 0);
  }

  bool adaptive() const override { return false; }

  Decisions decisions() const override {
    return {{"step", fmt::format("{}{:.6g} s ({}{})", options_.step.value ? "" : "auto, at first ", first_step_,
                                 critical_text(first_critical_), element_text())}};
  }

 private:
  static Remedies remedies(const CentralOptions& options) {
    if (options.step.value) return {"central_differences", "lower integrator.step, set it to auto,", "integrator.step"};
    return {"central_differences", "lower integrator.safety", "integrator.safety"};
  }

  void check_start(const Task& task) {
    try {
      monitor_.update(task.initial);
    } catch (const RecoverableError& e) {
      throw ConfigError(fmt::format(
          "central_differences needs the stiffness at the start, which could not be computed: {}", e.what()));
    }
    first_critical_ = monitor_.critical();
    if (options_.step.value && *options_.step.value > first_critical_)
      throw ConfigError(
          fmt::format("step: {:.6g} s is above the critical step, {:.6g} s; lower it, set `step: auto`, or use an "
                      "implicit integrator",
                      *options_.step.value, first_critical_));
    if (!options_.step.value && rattle_ && !std::isfinite(first_critical_))
      throw ConfigError(
          "step: auto finds no critical step, as nothing in the scene is deformable at the start: set a step that "
          "resolves the motion and later impacts, or use an implicit integrator");
    if (!options_.step.value) refuse_too_many_steps(task);
  }

  void refuse_too_many_steps(const Task& task) const {
    const double h = options_.safety * first_critical_;
    const double steps = (task.end - task.initial.t) / h;
    if (steps > static_cast<double>(options_.max_steps))
      throw ConfigError(
          fmt::format("central_differences would take {:.2g} steps of {:.3g} s ({}), more than max_steps, {}; use an "
                      "implicit integrator, or raise max_steps",
                      steps, h, critical_text(first_critical_), options_.max_steps));
  }

  std::string critical_text(double step) const {
    return fmt::format("critical {:.6g} s by Lanczos{}", step,
                       monitor_.expects_contact() ? ", with all contacts closed" : "");
  }

  // The critical step by element frequencies is cheaper to compute and shorter; it ignores damping and deformation.
  std::string element_text() const {
    const double omega = model_.frequency_bound();
    return omega > 0 ? fmt::format(", {:.6g} s by elements at rest, undamped", 2 / omega) : "";
  }

  void begin(StepEnd& at) override {
    if (rattle_) rattle_->finish(at);
    update({at.t, at.q, at.v});
  }

  void update(const State& state) {
    monitor_.update(state);
    choose_step();
  }

  void advance(double t_stop) override {
    const StepEnd& from = end();
    const double rest = t_stop - from.t, h = length(rest);
    next_.t = h == rest ? t_stop : from.t + h;
    a_ = rattle_ ? rattle_->free_acceleration() : from.a;
    next_.q = from.q + h * from.v + (0.5 * h * h) * a_;
    if (rattle_) constrain(h);
    predicted_ = from.v + h * a_;
    const VectorSpace space = model_.space();
    if (!space.all(next_.q.allFinite() && predicted_.allFinite())) fail_diverged();
    acceleration(next_.t, next_.q, predicted_, next_.a);
    if (has_diverged(h)) fail_diverged();
    next_.v = from.v + (0.5 * h) * (a_ + next_.a);
    if (rattle_) rattle_->finish(next_);
    if (monitor_.due()) update({next_.t, next_.q, next_.v});
  }

  // Puts next_.q on the constraints, and adds their forces to a_.
  void constrain(double h) {
    const Vector change = rattle_->change(next_.t, next_.q);
    next_.q += change;
    a_ += 2 / (h * h) * change;
  }

  // A wave crosses about one element in a stable step, so no force moves a node by the size of the body in one step.
  bool has_diverged(double h) const {
    return std::isfinite(monitor_.critical()) && h * h * model_.space().largest_entry(next_.a) > extent_;
  }

  [[noreturn]] void fail_diverged() const {
    fail(std::string("the motion has grown without bound; ") +
             (options_.step.value ? "set integrator.step: auto"
                                  : "lower integrator.safety, or use an implicit integrator"),
         Reason::diverged);
  }

  // Automatic steps divide the remaining time evenly: the map stays symplectic, and there is no tiny last step.
  double length(double rest) const {
    return options_.step.value ? length_of_fixed_step(step_, rest) : rest / std::ceil(rest / step_ * (1 - 1e-9));
  }

  void choose_step() {
    const double critical = monitor_.critical();
    if (options_.step.value) {
      step_ = *options_.step.value;
      if (step_ > critical)
        fail(
            fmt::format(
                "the critical step has fallen to {:.6g} s, below integrator.step, {:.6g} s; lower it or set it to auto",
                critical, step_),
            Reason::diverged);
    } else {
      step_ = std::isfinite(critical) ? options_.safety * critical : unbounded_;
    }
    if (first_step_ == 0) first_step_ = step_;
  }

  CentralOptions options_;
  CriticalStepMonitor monitor_;
  double unbounded_;  // step without stiffness and damping, s
  double extent_;     // m
  double step_ = 0, first_step_ = 0, first_critical_ = 0;
  Vector a_, predicted_;          // m/s^2, of the first half of the step; m/s
  std::optional<Rattle> rattle_;  // only for models with constraints
};

class CentralDifferencesChoice : public SettableChoice<CentralDifferencesChoice>, public CentralOptions {
 public:
  static const Spec<CentralDifferencesChoice>& spec() {
    using C = CentralDifferencesChoice;
    static const auto s =
        Spec<C>()
            .key("step", &C::step,
                 "Fixed step, refused above the critical step. auto: `safety` times the critical step, which is "
                 "recomputed as the deformation changes the stiffness.",
                 {.unit = "s", .range = kPositive})
            .key("safety", &C::safety, "Step divided by the critical step, with step: auto.",
                 {.range = {0, 1, true, true}})
            .key("max_steps", &C::max_steps, "Number of steps after which the run fails.", {.range = {1}})
            .check([](const C& options, const Config& config) {
              if (options.step.value && options.safety != CentralOptions{}.safety)
                config.at("safety").fail("is not used with a fixed step; remove it, or set `step: auto`");
            });
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2",
                        "conditional: step < 2/omega undamped, 2/omega (sqrt(1 + 4 xi^2) - 2 xi) damped; forces see "
                        "the predicted velocity v + h a",
                        "symplectic undamped: energy stays bounded; momentum and angular momentum exactly",
                        "Newmark 1959 (beta = 0); Verlet 1967; Hughes 1987, 9.1");
  }
  bool runs_on_ranks() const override { return true; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<CentralDifferences>(model, task, *this);
  }
};

const bool central_differences_registered = Registry<IntegratorChoice>::add<CentralDifferencesChoice>(
    "central_differences",
    "Leapfrog of order 2, explicit, one force per step, at a fixed step below the critical one.");

}  // namespace
}  // namespace orthodyn
