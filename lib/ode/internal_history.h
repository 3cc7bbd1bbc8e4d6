// Fixed steps of methods that know no internal variables (internal_variables.h). The strains are taken to change at a
// constant rate within a step, for which the internal variables have a closed form. The error of z is of order 2
// in the step, also for methods of higher order.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/ode/integrator.h"
#include "lib/ode/internal_model.h"

namespace orthodyn {

// The force at times t >= t0 with strains that have changed at a constant rate since the time t0 of begin().
class HistoryModel final : public InternalModel {
 public:
  using InternalModel::InternalModel;

  void begin(double t0, const Vector& q0, const Vector& z0) {
    t0_ = t0;
    z0_ = z0;
    e0_.resize(z0.size());
    internal().strains(t0, q0, e0_);
    known_at_.reset();
  }

  // The internal variables at a time t >= t0.
  Vector values(double t, const Vector& q) const {
    const InternalState z = internal_at(t);
    Vector e(z0_.size());
    internal().strains(t, q, e);
    const Vector& tau = internal().relaxation_times();
    for (Eigen::Index i = 0; i < e.size(); ++i) e[i] = z.values[i] + z.share(tau[i]) * e[i];
    return e;
  }

  std::size_t bytes() const { return 3 * static_cast<std::size_t>(z0_.size()) * sizeof(double); }

 private:
  InternalState internal_at(double t) const override {
    if (known_at_ != t) {
      known_ = advance_of_history(internal(), z0_, e0_, t - t0_);
      known_at_ = t;
    }
    return {InternalState::Kind::history, known_.data(), t - t0_};
  }

  double t0_ = 0;
  Vector z0_, e0_;
  mutable std::optional<double> known_at_;  // of known_, s
  mutable Vector known_;
};

class InternalHistory final : public Integrator {
 public:
  // make(model): the method for a model without internal variables. `model`, which has some, must outlive this object.
  // Throws ConfigError if the method's steps are adaptive.
  template <class Make>
  InternalHistory(const Model& model, Make&& make) : model_(model), method_(make(model_)) {
    if (method_->adaptive())
      throw ConfigError(
          "give a fixed `step`: the error control of this method does not see viscoelastic strains; "
          "cvode_bdf, ida_bdf and auto control their error");
  }

  void start(const State& state) override {
    model_.begin(state.t, state.q, internals_of(model_.internal(), state.t, state.q, state.z));
    end_.reset();
    method_->start(state);
  }

  StepInfo step(double t_stop) override {
    if (end_) {
      State begin;
      interpolate(*end_, begin);
      model_.begin(*end_, begin.q, begin.z);
    }
    const StepInfo info = method_->step(t_stop);
    end_ = info.t;
    return info;
  }

  void interpolate(double t, State& out) const override {
    method_->interpolate(t, out);
    out.z = model_.values(t, out.q);
  }
  std::optional<State> mean_state() const override {
    std::optional<State> mean = method_->mean_state();
    if (mean) mean->z = model_.values(mean->t, mean->q);
    return mean;
  }

  bool adaptive() const override { return false; }
  bool has_accurate_interpolation() const override { return method_->has_accurate_interpolation(); }
  double smooth_time() const override { return method_->smooth_time(); }
  const Statistics& statistics() const override { return method_->statistics(); }
  std::size_t factor_bytes() const override { return method_->factor_bytes(); }
  std::size_t bytes() const override { return method_->bytes() + model_.bytes(); }
  std::vector<std::pair<std::string, std::string>> decisions() const override { return method_->decisions(); }
  std::vector<std::string> result_warnings() const override { return method_->result_warnings(); }

 private:
  HistoryModel model_;
  std::unique_ptr<Integrator> method_;
  std::optional<double> end_;  // of the last step, s
};

}  // namespace orthodyn
