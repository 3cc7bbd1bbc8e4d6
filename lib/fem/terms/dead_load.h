// Dead forces on nodes i, with fixed directions: f_i = factor(t) F_i.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/fem/surface.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/ode/model.h"

namespace orthodyn {

class DeadLoad : public Term {
 public:
  // `forces`: nodal forces F_i (N) at factor 1. `amount`: text before the total force in description(), such as "4
  // nodes".
  DeadLoad(std::string name, NodalForces forces, std::shared_ptr<const TimeFunction> factor, std::string amount = "");

  std::string name() const override { return name_; }
  std::string description() const override;
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<DeadLoad>(name_, subdomain.owned(forces_), factor_, amount_);
  }
  bool is_dead() const override { return true; }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override;
  double seconds_at_peak(double start, double end) const override { return factor_->seconds_at_peak(start, end); }
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;
  StepLimits step_limits(double start, double end) const override { return factor_->step_limits(start, end); }

 private:
  std::string name_, amount_;
  NodalForces forces_;
  std::shared_ptr<const TimeFunction> factor_;
};

// Sets the traits of a model with a load that has this factor in time.
void declare_load(const TimeFunction& factor, Traits& traits);

}  // namespace orthodyn
