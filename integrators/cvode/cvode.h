// What CVODE's two families of linear multistep methods share (Hindmarsh et al. 2005): everything but the
// family, its highest order and the iteration of a step.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "integrators/sundials/first_order.h"
#include "integrators/sundials/newton_at_kinks.h"
#include "integrators/sundials/secant_newton.h"
#include "integrators/sundials/setup_schedule.h"

namespace orthodyn::sundials {

class Cvode : public FirstOrderIntegrator {
 protected:
  // `family` is CV_BDF or CV_ADAMS.
  Cvode(const std::string& name, const Model& model, const Settings& settings, int family, int max_order);

  // Attaches the iteration of a step.
  virtual void choose_iteration() = 0;

  // Modified Newton with the reduced or the full solver.
  void attach_newton();

  void* memory() const { return memory_.get(); }

  void initialise(double t) override;
  void reinitialise(double t) override;
  int advance(double t_stop, double& t) override;
  StepInfo last_step() const override;
  double current_step() const override;
  int dense_output(double t, N_Vector out) const override;
  Counters counters() const override;
  Reason classify(int flag) const override;
  std::size_t workspace_bytes() const override;

 private:
  struct FreeMemory {
    void operator()(void* memory) const;
  };

  void attach_reduced();
  void attach_full();

  int max_order_;
  SetupSchedule setups_;
  std::optional<SecantNewton> newton_;
  std::optional<NewtonAtKinks> newton_at_kinks_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace orthodyn::sundials
