#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "lib/fem/added_laws/fibre_law.h"
#include "lib/fem/added_laws/fibres.h"

namespace orthodyn {

namespace {

struct ActiveTension {
  double peak;  // Pa
  std::shared_ptr<const StretchFunction> length;
  std::shared_ptr<const RateFunction> velocity;  // null: f_V = 1
};

class ActiveFibresAt : public FibreLawAt {
 public:
  using Values = std::shared_ptr<const PointValues::At>;

  ActiveFibresAt(const ActiveTension& law, bool is_linear, Values activation, double load_factor)
      : FibreLawAt(is_linear), law_(law), activation_(std::move(activation)), factor_(load_factor * law.peak) {}

 private:
  Batch tension(std::size_t index, const Batch& x, const Batch* rate) const override {
    return isometric(index) * of_length(x) * of_rate(rate);
  }
  Batch slope(std::size_t index, const Batch& x, const Batch* rate) const override {
    return isometric(index) * of_rate(rate) * per_lane([&](int l) { return law_.length->slope(x[l]); });
  }
  Batch viscosity(std::size_t index, const Batch& x, const Batch& rate) const override {
    if (!law_.velocity) return Batch(0);
    return isometric(index) * of_length(x) * per_lane([&](int l) { return law_.velocity->slope(rate[l]); });
  }
  Batch mean_tension(std::size_t index, const Batch& x0, const Batch& x1) const override {
    return isometric(index) * per_lane([&](int l) { return law_.length->mean(x0[l], x1[l]); });
  }
  Batch potential(std::size_t index, const Batch& x) const override { return isometric(index) * work(x); }
  Batch supply(std::size_t index, const Batch& x) const override {
    return factor_ * activation_->rate(index) * work(x);
  }

  // The stress at the best stretch, Pa.
  Batch isometric(std::size_t index) const { return factor_ * activation_->value(index); }
  Batch of_length(const Batch& x) const {
    return per_lane([&](int l) { return law_.length->value(x[l]); });
  }
  Batch of_rate(const Batch* rate) const {
    if (!rate || !law_.velocity) return Batch(1);
    return per_lane([&](int l) { return law_.velocity->value((*rate)[l]); });
  }
  Batch work(const Batch& x) const {
    return per_lane([&](int l) { return law_.length->integral(x[l]); });
  }

  const ActiveTension& law_;
  Values activation_;
  Batch factor_;  // Pa
};

class ActiveFibres : public AddedLaw {
 public:
  ActiveFibres(ActiveTension law, bool is_linear, FibreActivation activation)
      : law_(std::move(law)), is_linear_(is_linear), activation_(std::move(activation)) {}

  std::string name() const override { return "active fibres"; }
  std::string description() const override {
    return fmt::format("{}: {:.4g} Pa{}", name(), law_.peak, law_.velocity ? ", less while shortening" : "");
  }
  std::size_t bytes() const override { return activation_.values->bytes(); }
  std::shared_ptr<const AddedLawAt> at(double t, double load_factor) const override {
    return std::make_shared<ActiveFibresAt>(law_, is_linear_, values(t), load_factor);
  }
  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<ActiveFibres>(law_, false, activation_);
  }

  bool is_load() const override { return true; }
  std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const override {
    return std::make_shared<ActiveFibresAt>(law_, is_linear_, activation_.values->at_peak(start, end), 1);
  }
  double seconds_at_peak(double start, double end) const override {
    return activation_.values->seconds_at_peak(start, end);
  }

  bool has_energy() const override { return true; }
  bool depends_on_rate() const override { return law_.velocity != nullptr; }
  bool depends_on_time() const override { return !activation_.values->constant(); }
  bool is_dead() const override { return false; }
  double largest_modulus() const override {
    return law_.peak * std::max(law_.length->slope_bound(), law_.length->value_bound());
  }

  std::vector<double> breakpoints(double start, double end) const override {
    return times_between(activation_.values->kinks(), start, end);
  }
  StepLimits step_limits(double start, double end) const override {
    return activation_.values->step_limits(start, end);
  }

 private:
  // The activation at a time, each value within [0, 1] up to round-off of formulas.
  ActiveFibresAt::Values values(double t) const {
    constexpr double kRoundOff = 1e-12;
    auto found = activation_.values->at(t);
    const std::scoped_lock lock(mutex_);
    if (found == checked_) return found;
    for (std::size_t index = 0; index < found->size(); ++index)
      for (int l = 0; l < Batch::kLanes; ++l)
        if (const double a = found->value(index)[l]; !(a >= -kRoundOff && a <= 1 + kRoundOff)) refuse(t, a, index, l);
    checked_ = found;
    return found;
  }

  void refuse(double t, double value, std::size_t index, int lane) const {
    const auto points = static_cast<std::size_t>(activation_.points_per_element);
    activation_.refuse(t, value, static_cast<Eigen::Index>(index / points) * Batch::kLanes + lane);
  }

  ActiveTension law_;
  bool is_linear_;
  FibreActivation activation_;
  mutable std::mutex mutex_;
  mutable ActiveFibresAt::Values checked_;  // the last values that were found within [0, 1]
};

}  // namespace

std::unique_ptr<AddedLaw> make_active_fibres(const ActiveFibre& fibre, Kinematics kinematics,
                                             FibreActivation activation) {
  return std::make_unique<ActiveFibres>(
      ActiveTension{fibre.stress, fibre.length->factor(), fibre.velocity ? fibre.velocity->factor() : nullptr},
      kinematics == Kinematics::linear, std::move(activation));
}

}  // namespace orthodyn
