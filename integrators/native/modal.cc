// Small vibrations by their lowest modes, each integrated exactly:
//
//   q = Phi r + u,   r'' + d r' + lambda r = phi' f(t, 0, 0),   u = S (f - M Phi Phi' f),
//
// with the static response u of the modes left out (modal_basis.h, modal_motion.h). The load is interpolated over a
// step by a polynomial of degree 5, whose error at two more points controls the step; a load that is one is integrated
// exactly over steps of any length.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/native/modal_basis.h"
#include "integrators/native/modal_load.h"
#include "integrators/native/modal_motion.h"
#include "integrators/native/modal_trial.h"
#include "integrators/native/modal_truncation.h"
#include "integrators/native/step_control.h"
#include "integrators/scaled_norm.h"
#include "lib/core/errors.h"

namespace orthodyn {
namespace {

constexpr double kMisfit = 0.05;       // of the motion: a start that the modes do not represent
constexpr double kShorter = 0.25;      // after a force that cannot be evaluated
constexpr double kSmoothPhase = 0.5;   // rad, of the motion between two looks at it
constexpr int kLooksAtLoad = 4;        // in a step in which it varies
constexpr int kLeastSteps = 50;        // of a run whose load may vary
constexpr int kRestingIntervals = 10;  // in a step after one in which it did not vary

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
        control_(kLoadTerms + 1),
        truncation_(basis_) {
    if (model.traits().time_dependent) {
      interval_ = (task.end - task.initial.t) / kLeastSteps;
      if (task.output_interval > 0) interval_ = std::min(interval_, task.output_interval);
    }
  }

  void start(const State& state) override {
    from_ = state;
    begin_ = end_ = modal_state(basis_, state);
    load_ = {};
    is_starting_ = true;
    h_ = 0;
    control_.restart();
  }

  StepInfo step(double t_stop) override {
    if (statistics_.steps >= options_.max_steps)
      throw RunError(fmt::format("modal gave up at t = {:.6g} s after {} steps (max_steps); raise "
                                 "integrator.max_steps or integrator.rtol",
                                 time(), statistics_.steps),
                     Reason::too_many_steps);
    const double t = time(), rest = t_stop - t;
    if (h_ == 0) h_ = options_.h0.value_or(rest);
    StepLoad load;
    bool refused = false;
    for (;;) {
      const double h = length_of_step(std::min(h_, longest()), rest);
      const std::optional<double> error = try_step(t, h, load);
      if (error && *error <= 1) {
        const double factor = control_.after_success(*error);
        const double proposed = h * (refused ? std::min(factor, 1.0) : factor);
        h_ = h < h_ ? std::max(h_, proposed) : proposed;  // a stop or a limit cut the step short
        break;
      }
      refused = true;
      ++statistics_.rejected_steps;
      ++(error ? statistics_.error_test_failures : statistics_.convergence_failures);
      h_ = h * (error ? control_.after_failure(*error) : kShorter);
      refuse_tiny_steps(error.has_value());
    }
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
    out.q += load_.rest_at(tau / load_.h);
    if (load_.varies) out.v += load_.rest_rate(tau / load_.h);
  }

  // The polynomials of others are to follow the modes that hold the energy.
  double smooth_time() const override {
    if (load_.h == 0) return std::numeric_limits<double>::infinity();
    const ModalState before{begin_.r - modal_equilibrium(basis_, load_.modal_at(0)), begin_.rate};
    const ModalState after{end_.r - modal_equilibrium(basis_, load_.modal_at(1)), end_.rate};
    double energy = 0, rates = 0;
    for (const ModalState& at : {before, after})
      for (Eigen::Index k = 0; k < basis_.size(); ++k) {
        const double lambda = basis_.lambda()[k], d = basis_.damping()[k];
        const double kinetic = at.rate[k] * at.rate[k], elastic = lambda * at.r[k] * at.r[k];
        const bool overdamped = d * d > 4 * lambda;  // velocities then die at the rate d, deformations at lambda/d
        energy += kinetic + elastic;
        rates += overdamped ? kinetic * d * d + elastic * std::pow(lambda / d, 2) : lambda * (kinetic + elastic);
      }
    const double of_load = load_.varies ? load_.h / kLooksAtLoad : std::numeric_limits<double>::infinity();
    return rates > 0 ? std::min(of_load, kSmoothPhase / std::sqrt(rates / energy)) : of_load;
  }

  // Throws ConfigError if the modes miss more than kMisfit of the motion that the initial state and the loads start.
  void check_start(const State& initial) {
    StepLoad load;
    try {
      load = loads_.at(initial.t);
    } catch (const RecoverableError&) {
      return;  // the first step will tell, with the time
    }
    from_ = initial;
    begin_ = modal_state(basis_, initial);
    ModalTruncation at_start(basis_);
    at_start.start(initial, begin_, load);
    at_start.reach(begin_, load, 0);
    if (const double share = at_start.displacement_share(); share > kMisfit)
      throw ConfigError(fmt::format(
          "the modes kept ({}) do not contain the motion that the initial state and the loads start: about "
          "{:.2g} of it is in those left out; keep more of them (`modes`, `below`), or use another integrator",
          basis_.size(), share));
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
    return {fmt::format(
        "the modes that were left out would have moved by about {:.2g} of the motion, with {:.2g} of "
        "its velocity. Keep more modes (integrator.modes, now {}; integrator.below), or use another integrator",
        truncation_.displacement_share(), truncation_.velocity_share(), basis_.size())};
  }

 private:
  double time() const { return load_.h > 0 ? end_time_ : from_.t; }

  // A load that may vary is looked at about as often as the motion.
  double longest() const {
    const bool rests = load_.h > 0 && !load_.varies;
    const double looked_at = rests ? kRestingIntervals * interval_ : interval_;
    return std::min(looked_at, options_.h_max.value_or(looked_at));
  }

  std::string kept_text() const {
    const double highest = std::sqrt(basis_.lambda()[basis_.size() - 1]) / (2 * std::numbers::pi);
    std::string text = fmt::format("{} modes up to {:.6g} Hz", basis_.size(), highest);
    if (basis_.is_complete()) return text + ", all there are";
    const bool begun = statistics_.steps > 0;
    const double share = begun ? truncation_.displacement_share() : share_at_start_;
    if (!begun && share == 0) return text;  // the loads will tell
    text += fmt::format("; what is left out{} is about {:.2g} of the motion", begun ? "" : " at the start", share);
    return share > options_.rtol ? text + ", more than rtol (keep more modes to reduce it)" : text;
  }

  // The error of a step in units of the tolerance; none if a force cannot be evaluated.
  std::optional<double> try_step(double t, double h, StepLoad& load) {
    cause_.clear();
    try {
      load = loads_.over(t, h);
      return loads_.error(load, norm_);
    } catch (const RecoverableError& e) {
      cause_ = e.what();
      return std::nullopt;
    }
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
    const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::abs(time());
    if (h_ > std::max({options_.h_min, resolution, std::numeric_limits<double>::min()})) return;
    const std::string stopped = fmt::format("modal stopped at t = {:.6g} s: ", time());
    if (by_error)
      throw RunError(stopped +
                         "the load cannot be followed to the tolerance; raise integrator.rtol, lower "
                         "integrator.h_min, or look for a kink in the loads",
                     Reason::error_test);
    throw RunError(stopped + "the force cannot be evaluated (" + cause_ +
                       "); lower integrator.h_max or check the initial state and the loads",
                   Reason::force);
  }

  const Model& model_;
  ModalOptions options_;
  Statistics statistics_;
  ModalBasis basis_;
  ModalLoad loads_;
  Scales scales_;
  ScaledNorm norm_;
  StepControl control_;
  ModalTruncation truncation_;
  double interval_ = std::numeric_limits<double>::infinity();  // between looks at a load that may vary, s
  double h_ = 0;                                               // proposed; 0 before the first step
  State from_;                                                 // of the last start
  bool is_starting_ = false;
  double share_at_start_ = 0;  // of the motion that the initial state starts, lost
  StepLoad load_;              // of the last step; h = 0 before the first one
  double end_time_ = 0;
  ModalState begin_, end_;  // of the last step
  std::string cause_;       // why a force could not be evaluated
};

class ModalChoice : public SettableChoice<ModalChoice>, public ModalOptions {
 public:
  static const Spec<ModalChoice>& spec() {
    using C = ModalChoice;
    static const auto s =
        ErrorControl::spec_for<C>()
            .key("modes", &C::modes,
                 "How many of the lowest modes are kept, rigid motions among them; all if there "
                 "are fewer. This or `below` is required.",
                 {.range = {1}})
            .key("below", &C::below, "Keeps the modes below this frequency.", {.unit = "Hz", .range = kPositive})
            .key("kept", &C::kept, "What was kept, and what that leaves out, in words; written by the program.")
            .check([](const C& options, const Config& config) {
              if (options.modes && options.below)
                config.at("below").fail("has no meaning beside `modes`; remove one of the two");
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
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    if (!modes && !below)
      throw ConfigError(
          "modal needs to know which modes to keep: give `modes`, such as 40, or `below`, such as 2 kHz "
          "(`orthodyn modes` lists the frequencies of a scene)");
    auto modal = std::make_unique<Modal>(model, task, *this);
    modal->check_start(task.initial);
    return modal;
  }
};

const bool modal_registered = Registry<IntegratorChoice>::add<ModalChoice>(
    "modal", "Linear models by their lowest modes, each exact in time, with the static response of the others.");

}  // namespace

std::optional<ModalTrial> try_modal(const Model& model, const Task& task, const ErrorControl& control, int modes,
                                    long most_steps) {
  ModalOptions options;
  static_cast<ErrorControl&>(options) = control;
  options.modes = modes;
  Task unseen = task;
  unseen.output_interval = 0;  // outputs do not change what is left out, and looks at the load for them would cost
  Modal modal(model, unseen, options);
  try {
    modal.check_start(task.initial);
  } catch (const ConfigError&) {  // more modes may do
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
