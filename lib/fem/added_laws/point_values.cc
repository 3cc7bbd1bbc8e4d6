#include "lib/fem/added_laws/point_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orthodyn {

inline namespace ORTHODYN_LANES {

std::shared_ptr<const PointValues::At> PointValues::at(double t) const {
  const std::scoped_lock lock(mutex_);
  if (last_ && (t == time_ || constant())) return last_;
  last_ = std::make_shared<At>(packed([&](const Note& note) { evaluate(t, note); }),
                               [this, t] { return packed([&](const Note& note) { evaluate_rates(t, note); }); });
  time_ = t;
  return last_;
}

std::shared_ptr<const PointValues::At> PointValues::at_peak(double start, double end) const {
  return std::make_shared<At>(packed([&](const Note& note) { evaluate_peak(start, end, note); }), nullptr);
}

std::vector<Batch> PointValues::packed(const std::function<void(const Note&)>& evaluate) const {
  constexpr auto kLanes = static_cast<Eigen::Index>(Batch::kLanes);
  const Eigen::Index elements = size() / points_, batches = (elements + kLanes - 1) / kLanes;
  Eigen::ArrayXXd lanes(kLanes, batches * points_);  // column: LawPoint::index
  evaluate([&](Eigen::Index index, double value) {
    const Eigen::Index k = index / points_, column = k / kLanes * points_ + index % points_;
    // The last element fills the lanes after it.
    for (Eigen::Index lane = k % kLanes; lane < (k + 1 < elements ? k % kLanes + 1 : kLanes); ++lane)
      lanes(lane, column) = value;
  });
  std::vector<Batch> out;
  out.reserve(static_cast<std::size_t>(lanes.cols()));
  for (Eigen::Index i = 0; i < lanes.cols(); ++i) out.push_back(Batch::load(&lanes(0, i)));
  return out;
}

}  // namespace ORTHODYN_LANES

namespace {

class ScaledValues : public PointValues {
 public:
  ScaledValues(Vector values, std::shared_ptr<const TimeFunction> factor, int points)
      : PointValues(points), values_(std::move(values)), factor_(std::move(factor)) {}

  bool constant() const override { return factor_->constant(); }
  std::size_t bytes() const override { return 3 * static_cast<std::size_t>(values_.size()) * sizeof(double); }
  std::vector<double> kinks() const override { return factor_->kinks(); }
  StepLimits step_limits(double start, double end) const override { return factor_->step_limits(start, end); }
  double seconds_at_peak(double start, double end) const override { return factor_->seconds_at_peak(start, end); }

 private:
  void evaluate(double t, const Note& note) const override { note_multiples(factor_->value(t), note); }
  void evaluate_rates(double t, const Note& note) const override { note_multiples(factor_->rate(t), note); }
  void evaluate_peak(double start, double end, const Note& note) const override {
    note_multiples(factor_->peak(start, end), note);
  }
  void note_multiples(double factor, const Note& note) const {
    for (Eigen::Index i = 0; i < values_.size(); ++i) note(i, factor * values_[i]);
  }
  Eigen::Index size() const override { return values_.size(); }

  Vector values_;
  std::shared_ptr<const TimeFunction> factor_;
};

class FormulaValues : public PointValues {
 public:
  FormulaValues(TimePointFormula formula, Eigen::Matrix3Xd places, Eigen::Matrix3Xd samples, double start, double end,
                std::vector<double> kinks, int points)
      : PointValues(points),
        formula_(std::move(formula)),
        is_constant_(!formula_.uses("t")),
        places_(std::move(places)),
        samples_(std::move(samples)),
        kinks_(std::move(kinks)),
        limits_(kinks_),
        step_(step_limits(start, end), start, end) {
    limits_.push_back(start);
  }

  bool constant() const override { return is_constant_; }
  std::size_t bytes() const override { return static_cast<std::size_t>(places_.size() + 2 * size()) * sizeof(double); }
  std::vector<double> kinks() const override { return kinks_; }
  double seconds_at_peak(double start, double end) const override { return end - start; }

  StepLimits step_limits(double start, double end) const override {
    StepLimits limits;
    if (constant() || !(end > start)) return limits;
    for (Eigen::Index i = 0; i < samples_.cols(); ++i)
      limits.add(StepLimits::of([&](double t) { return formula_.at(t, samples_.col(i)); }, start, end, kinks_));
    return limits;
  }

 private:
  void evaluate(double t, const Note& note) const override {
    for (Eigen::Index i = 0; i < places_.cols(); ++i) note(i, formula_.at(t, places_.col(i)));
  }
  void evaluate_rates(double t, const Note& note) const override {
    for (Eigen::Index i = 0; i < places_.cols(); ++i) {
      const auto value = [&](double time) { return formula_.at(time, places_.col(i)); };
      note(i, constant() ? 0 : smooth_differences<double>(value, t, step_.at(t), limits_).first);
    }
  }
  // The largest of some values in the time span.
  void evaluate_peak(double start, double end, const Note& note) const override {
    const int samples = constant() || !(end > start) ? 0 : 50;
    for (Eigen::Index i = 0; i < places_.cols(); ++i) {
      double peak = formula_.at(end, places_.col(i));
      for (int k = 0; k < samples; ++k) {
        const double value = formula_.at(start + k * (end - start) / samples, places_.col(i));
        if (std::abs(value) > std::abs(peak)) peak = value;
      }
      note(i, peak);
    }
  }
  Eigen::Index size() const override { return places_.cols(); }

  TimePointFormula formula_;
  bool is_constant_;
  Eigen::Matrix3Xd places_, samples_;
  std::vector<double> kinks_, limits_;  // limits_: kinks and start, which differences do not cross
  DifferenceStep step_;
};

}  // namespace

std::unique_ptr<PointValues> scaled_values(Vector values, std::shared_ptr<const TimeFunction> factor,
                                           int points_per_element) {
  return std::make_unique<ScaledValues>(std::move(values), std::move(factor), points_per_element);
}

std::unique_ptr<PointValues> formula_values(TimePointFormula formula, Eigen::Matrix3Xd places, Eigen::Matrix3Xd samples,
                                            double start, double end, std::vector<double> kinks,
                                            int points_per_element) {
  return std::make_unique<FormulaValues>(std::move(formula), std::move(places), std::move(samples), start, end,
                                         std::move(kinks), points_per_element);
}

}  // namespace orthodyn
