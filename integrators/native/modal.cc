// Integrates small vibrations by their lowest modes phi, the columns of Phi, each exactly in time:
//
//   q = Phi r + u,   r'' + d r' + lambda r = phi^T f(t, 0, 0),   u = S (f - M Phi Phi^T f),
//
// where u is the static correction for the modes left out (modal_basis.h). The load is interpolated over a step by a
// polynomial of degree 5, and the interpolation error at two more points controls the step. Polynomial loads up to
// degree 5 are integrated exactly over steps of any length.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/native/modal_basis.h"
#include "integrators/native/modal_load.h"
#include "integrators/native/modal_trial.h"
#include "integrators/native/modal_truncation.h"
#include "integrators/native/step_controllers.h"
#include "integrators/run_checks.h"
#include "integrators/scaled_norm.h"
#include "lib/core/errors.h"
#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

constexpr double kMisfit = 0.05;      // largest share left out; more is an error at the start, a warning in the result
constexpr double kSmoothPhase = 0.5;  // largest phase of the motion between two samples, rad
constexpr int kLoadSamples = 4;       // samples in a step with a varying load
constexpr int kMinSteps = 50;         // fewest steps of a run whose load may vary
constexpr int kConstantIntervals = 10;  // sampling intervals per step while the load is constant

struct ModalOptions : ErrorControl, ModeLimit {
  std::string kept;
};

ModalBasis measured_basis(const Model& model, const ModeLimit& limit, Statistics& statistics) {
  const Measure measure(statistics.modes);
  return ModalBasis(model, limit);
}

class Modal : public Integrator {
 public:
  Modal(const Model& model, const Task& task, const ModalOptions& options)
      : model_(model),
        options_(options),
        basis_(measured_basis(model, options, statistics_)),
        loads_(model, basis_, statistics_),
        scales_(options.scales(task)),
        norm_(options.rtol, scales_),
        adaptive_(kLoadTerms + 1),
        truncation_(basis_) {
    if (model.traits().time_dependent) {
      interval_ = (task.end - task.initial.t) / kMinSteps;
      if (task.output_interval > 0) interval_ = std::min(interval_, task.output_interval);
    }
  }

  void start(const State& state) override {
    from_ = state;
    begin_ = end_ = modal_state(basis_, state);
    load_ = {};
    is_starting_ = true;
    adaptive_.restart();
  }

  StepInfo step(double t_stop) override {
    if (statistics_.steps >= options_.max_steps)
      throw too_many_steps_error("modal", time(), statistics_.steps, "integrator.rtol");
    const double t = time(), rest = t_stop - t;
    if (adaptive_.proposed() == 0) adaptive_.propose(options_.h0.value_or(rest));
    StepLoad load;
    adaptive_.take(
        statistics_, [&] { return length_of_step(std::min(adaptive_.proposed(), longest()), rest); },
        [&](double h) {
          load = loads_.over(t, h);
          return loads_.error(load, norm_);
        },
        [&](bool has_error) { refuse_tiny_steps(has_error); });
    take(std::move(load), t_stop);
    return {end_time_, load_.h, kLoadTerms - 1};
  }

  void interpolate(double t, State& out) const override {
    if (load_.h == 0) {  // before the first step
      out = from_;
      return;
    }
    const double tau = t - load_.t;
    const ModalState now = t == end_time_ ? end_ : modal_state_after(basis_, begin_, load_, tau);
    out.t = t;
    out.q = basis_.shapes() * now.r;
    out.v = basis_.shapes() * now.rate;
    if (basis_.is_complete()) return;
    out.q += load_.correction_at(tau / load_.h);
    if (load_.varies) out.v += load_.correction_rate(tau / load_.h);
  }

  // Uses the mean square frequency of the modes, weighted by their energy.
  double smooth_time() const override {
    if (load_.h == 0) return std::numeric_limits<double>::infinity();
    const ModalState before{begin_.r - modal_equilibrium(basis_, load_.modal_at(0)), begin_.rate};
    const ModalState after{end_.r - modal_equilibrium(basis_, load_.modal_at(1)), end_.rate};
    double energy = 0, rates = 0;
    for (const ModalState& at : {before, after})
      for (Eigen::Index k = 0; k < basis_.size(); ++k) {
        const double lambda = basis_.lambda()[k], d = basis_.damping()[k];
        const double kinetic = at.rate[k] * at.rate[k], elastic = lambda * at.r[k] * at.r[k];
        const bool overdamped = d * d > 4 * lambda;  // velocities then decay at the rate d, deformations at lambda/d
        energy += kinetic + elastic;
        rates += overdamped ? kinetic * d * d + elastic * std::pow(lambda / d, 2) : lambda * (kinetic + elastic);
      }
    const double load_time = load_.varies ? load_.h / kLoadSamples : std::numeric_limits<double>::infinity();
    return rates > 0 ? std::min(load_time, kSmoothPhase / std::sqrt(rates / energy)) : load_time;
  }

  // Throws ConfigError if the modes leave out more than kMisfit of the motion that the initial state and loads cause.
  void check_start(const State& initial) {
    StepLoad load;
    try {
      load = loads_.at(initial.t);
    } catch (const RecoverableError&) {
      return;  // the first step reports the error
    }
    from_ = initial;
    begin_ = modal_state(basis_, initial);
    ModalTruncation at_start(basis_);
    at_start.start(initial, begin_, load);
    at_start.record_motion(begin_, load, 0);
    if (const double share = at_start.displacement_share(); share > kMisfit)
      throw ConfigError(
          fmt::format("the {} kept cannot represent about {:.2g} of the motion that the initial state and the loads "
                      "cause; keep more modes (`modes`, `below`), or use another integrator",
                      counted(basis_.size(), "mode"), share));
    share_at_start_ = at_start.displacement_share();
  }

  const ModalTruncation& truncation() const { return truncation_; }

  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return basis_.factor_bytes(); }
  std::size_t bytes() const override {
    const auto n = static_cast<std::size_t>(model_.num_dofs()), m = static_cast<std::size_t>(basis_.size());
    return basis_.bytes() + sizeof(double) * (3 * kLoadTerms + 10) * (n + m);
  }

  Decisions decisions() const override {
    Decisions all = scale_decisions(scales_);
    all.emplace_back("kept", kept_text());
    return all;
  }

  std::vector<std::string> result_warnings() const override {
    const double share = std::max(truncation_.displacement_share(), truncation_.velocity_share());
    if (share <= kMisfit) return {};
    return {
        fmt::format("the modes left out would have contributed about {:.2g} of the motion and {:.2g} of its velocity. "
                    "Keep more modes (integrator.modes, now {}; integrator.below), or use another integrator",
                    truncation_.displacement_share(), truncation_.velocity_share(), basis_.size())};
  }

 private:
  double time() const { return load_.h > 0 ? end_time_ : from_.t; }

  // Longest step (s). It limits the time between samples of a load that may vary.
  double longest() const {
    const bool is_constant = load_.h > 0 && !load_.varies;
    const double sampled = is_constant ? kConstantIntervals * interval_ : interval_;
    return std::min(sampled, options_.h_max.value_or(sampled));
  }

  std::string kept_text() const {
    const double highest = std::sqrt(basis_.lambda()[basis_.size() - 1]) / (2 * std::numbers::pi);
    std::string text = fmt::format("{} modes up to {:.6g} Hz", basis_.size(), highest);
    if (basis_.is_complete()) return text + ", all modes of the model";
    const bool begun = statistics_.steps > 0;
    const double share = begun ? truncation_.displacement_share() : share_at_start_;
    if (!begun && share == 0) return text;  // unknown until the loads act
    text += fmt::format("; the part left out{} is about {:.2g} of the motion", begun ? "" : " at the start", share);
    return share > options_.rtol ? text + ", more than rtol (keep more modes to reduce it)" : text;
  }

  void take(StepLoad&& load, double t_stop) {
    load_ = std::move(load);
    begin_ = end_;
    end_time_ = load_.h == t_stop - load_.t ? t_stop : load_.t + load_.h;
    if (is_starting_) truncation_.start(from_, begin_, load_);
    is_starting_ = false;
    end_ = modal_state_after(basis_, begin_, load_, load_.h);
    ++statistics_.steps;
    truncation_.step(begin_, end_, load_);
  }

  void refuse_tiny_steps(bool by_error) const {
    if (!adaptive_.is_too_short(options_.h_min, time())) return;
    const std::string stopped = fmt::format("modal stopped at t = {:.6g} s: ", time());
    if (by_error)
      throw RunError(stopped +
                         "the load cannot be followed to the tolerance; raise integrator.rtol, lower integrator.h_min, "
                         "or look for a kink in the loads",
                     Reason::error_test);
    throw RunError(
        stopped + adaptive_.cause().explain("the force cannot be evaluated",
                                            "; lower integrator.h_max or check the initial state and the loads"),
        Reason::force);
  }

  const Model& model_;
  ModalOptions options_;
  Statistics statistics_;
  ModalBasis basis_;
  ModalLoad loads_;
  Scales scales_;
  ScaledNorm norm_;
  AdaptiveStep adaptive_;
  ModalTruncation truncation_;
  double interval_ = std::numeric_limits<double>::infinity();  // s, step limit for a load that may vary
  State from_;                                                 // state at the last start
  bool is_starting_ = false;
  double share_at_start_ = 0;  // share of the initial motion left out
  StepLoad load_;              // load of the last step; h = 0 before the first step
  double end_time_ = 0;
  ModalState begin_, end_;  // at the ends of the last step
};

class ModalChoice : public SettableChoice<ModalChoice>, public ModalOptions {
 public:
  static const Spec<ModalChoice>& spec() {
    using C = ModalChoice;
    static const auto s =
        ErrorControl::spec_for<C>()
            .key("modes", &C::modes,
                 "Number of lowest modes to keep, rigid motions included; all if there are fewer. This or `below` is "
                 "required.",
                 {.range = {1}})
            .key("below", &C::below, "Keeps the modes below this frequency.", {.unit = "Hz", .range = kPositive})
            .key("kept", &C::kept,
                 "Modes kept and the share of the motion that they leave out; written by the program.")
            .check([](const C& options, const Config& config) {
              if (options.modes && options.below)
                config.at("below").fail("cannot be combined with `modes`; remove one of the two");
            });
    return s;
  }
  static MethodFacts facts() {
    return method_facts("exact in time for loads that are polynomials of degree 5 in a step",
                        "any step; linear models whose damping does not couple the modes",
                        "energy of the kept modes, undamped, and momentum of a free body",
                        "Hughes 1987, 7.2 (modes); Cornwell, Craig & Johnson, Earthquake Eng. Struct. Dyn. 11, 1983 "
                        "(static correction)");
  }
  bool needs_linear_model() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    if (!modes && !below)
      throw ConfigError(
          "modal needs the modes to keep: set `modes`, such as 40, or `below`, such as 2 kHz (`orthodyn modes` lists "
          "the frequencies of a scene)");
    auto modal = std::make_unique<Modal>(model, task, *this);
    modal->check_start(task.initial);
    return modal;
  }
};

const bool modal_registered = Registry<IntegratorChoice>::add<ModalChoice>(
    "modal", "Linear models by their lowest modes, each exact in time, with the static correction for the others.");

}  // namespace

std::optional<ModalTrial> try_modal(const Model& model, const Task& task, const ErrorControl& control, int modes,
                                    long most_steps) {
  ModalOptions options;
  static_cast<ErrorControl&>(options) = control;
  options.modes = modes;
  Task unseen = task;
  unseen.output_interval = 0;  // outputs would cost samples of the load and do not change the shares
  Modal modal(model, unseen, options);
  try {
    modal.check_start(task.initial);
  } catch (const ConfigError&) {  // more modes may suffice
    return ModalTrial{1, 1, 0};
  }
  const StepLimits limits = model.step_limits(task.initial.t, task.end);
  std::vector<double> ends = model.breakpoints(task.initial.t, task.end);
  ends.push_back(task.end);
  State state = task.initial;
  for (const double end : ends) {
    modal.start(state);
    for (double t = state.t; t < end;) {
      if (modal.statistics().steps >= most_steps) return std::nullopt;
      t = modal.step(std::min(end, limits.latest_end(t))).t;
    }
    modal.interpolate(end, state);
  }
  const ModalTruncation& left_out = modal.truncation();
  return ModalTrial{left_out.displacement_share(), left_out.velocity_share(), modal.statistics().steps};
}

}  // namespace orthodyn
