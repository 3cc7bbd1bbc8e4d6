#include "lib/fem/terms/joint_load.h"

#include <fmt/format.h>

namespace orthodyn {

namespace {

class JointLoad final : public Term {
 public:
  JointLoad(std::string joint, JointCoordinate coordinate, double amount, std::shared_ptr<const TimeFunction> factor,
            const BlockPattern& pattern)
      : joint_(std::move(joint)),
        coordinate_(std::move(coordinate)),
        nodes_(coordinate_),
        amount_(amount),
        factor_(std::move(factor)),
        pattern_(pattern) {}

  std::string name() const override { return "load of joint " + joint_; }
  std::string description() const override {
    const bool constant = factor_->constant();
    return fmt::format("joint {}: load, {:.6g} {}{}", joint_, constant ? amount_ * factor_->value(0) : amount_,
                       coordinate_.is_angle() ? "N m" : "N", constant ? "" : " at factor 1");
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    nodes_.add_force(amount_ * factor_->value(s.t), coordinate_.expand(s.u), f);
  }
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override {
    nodes_.add_force(amount_ * factor_->peak(s.t, end), coordinate_.expand(s.u), f);
  }
  double seconds_at_peak(double start, double end) const override { return factor_->seconds_at_peak(start, end); }
  bool has_mean_force() const override { return false; }

  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const override {
    if (kind == TangentKind::gauss_newton) return;
    nodes_.add_tangent(0, amount_ * factor_->value(s.t), coordinate_.expand(s.u), pattern_, stiffness);
  }

  double load_power(const NodalState& s) const override {
    return amount_ * factor_->value(s.t) * coordinate_.rate(s.u, s.v);
  }

  std::vector<double> breakpoints(double start, double end) const override {
    return times_between(factor_->kinks(), start, end);
  }
  StepLimits step_limits(double start, double end) const override { return factor_->step_limits(start, end); }

 private:
  std::string joint_;
  JointCoordinate coordinate_;
  CoordinateNodes nodes_;
  double amount_;
  std::shared_ptr<const TimeFunction> factor_;
  const BlockPattern& pattern_;
};

}  // namespace

std::unique_ptr<Term> joint_load_term(std::string joint, JointCoordinate coordinate, double amount,
                                      std::shared_ptr<const TimeFunction> factor, const BlockPattern& pattern) {
  return std::make_unique<JointLoad>(std::move(joint), std::move(coordinate), amount, std::move(factor), pattern);
}

}  // namespace orthodyn
