// Watches the error of linear kinematics during a run, and ends the run when it exceeds a limit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/analysis/linearity.h"
#include "lib/simulation/error_estimate/linear_phase_error.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// An entry of the scene's `regions` with linear kinematics, and its elastic terms.
struct LinearRegion {
  std::string name;
  Linearity::Terms terms;
};

// A request to repeat a run with corotational kinematics in these entries of `regions`.
struct KinematicsRestart {
  std::vector<std::string> regions;
  std::string why;  // a sentence
};

// The error is the sum of the error of the largest displacement so far (Linearity) and the phase error of the vibration
// (PhaseError). It is relative to the largest displacement, in the mass norm. The observer functions throw RunError
// when it exceeds `allowed`.
class LinearityWatch : public Observer {
 public:
  // `model` must outlive the watch. The motion lasts from `start` to `end` (s); `end` is infinite in statics.
  // `allowed`: largest relative error; if infinite, the error is only reported, at the end. `only_linear`: the type of
  // the integrator if it supports linear kinematics only; else "".
  LinearityWatch(const FemModel& model, std::vector<LinearRegion> regions, double start, double end, double allowed,
                 std::string only_linear = "");

  void on_start(const ObservedState& observed) override { observe(observed.state()); }
  void on_resume(const ObservedState& observed) override { observe(observed.state()); }
  void on_output(const ObservedState& observed) override { observe(observed.state()); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    observe(observed.state());
  }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // The error of one state, without phase error. Throws RunError if the tangent at rest cannot be factorised.
  LinearityError error_at(double t, const Vector& q) { return linearity().error(t, q); }

  // Completes error() at the end of a motion. error() is NaN if it cannot be computed.
  void finish();
  // Completes error() for one state, the last equilibrium of a static analysis.
  void finish_at(double t, const Vector& q);
  // Calls finish_at() and throws RunError if the error exceeds the limit. Does nothing without a limit.
  void require(double t, const Vector& q);

  const std::vector<LinearRegion>& regions() const { return regions_; }
  bool covers_all_regions() const;
  double allowed() const { return allowed_; }
  double error() const { return error_; }      // largest so far, phase error included
  bool unstable() const { return unstable_; }  // true if LinearityError::unstable was set for any state
  bool exceeds_allowed() const { return error_ > allowed_; }
  double time() const { return time_; }  // of the last state observed, s

  // The regions that must become corotational, judged at a state. The region with the largest error is always included.
  // Those with the smallest errors are left out as long as their errors add up to at most allowed / 2.
  std::vector<std::string> corotational_regions(double t, const Vector& q);

  // The restart that is needed; empty if the error is within the limit or the integrator supports linear kinematics
  // only.
  std::optional<KinematicsRestart> kinematics_restart();

 private:
  struct Largest {
    double t = 0, norm = 0;  // s; mass norm
    Vector q = {};
  };

  void observe(const State& state);
  void throw_exceeded() const;
  void update_error(double t, const Vector& q);
  double next_check() const;  // displacement (mass norm) above which the error is computed again
  void update_phase_error();
  double relative_phase_error(double phase) const;
  double phase_error_of(double stiffness) const;  // part of the phase error due to terms with this stiffness error
  Linearity& linearity();

  const FemModel& model_;
  std::vector<LinearRegion> regions_;
  std::optional<Linearity> linearity_;  // made on first use
  double allowed_, span_, time_;
  Largest largest_;
  double checked_ = 0;                // displacement (mass norm) at which the error was last computed
  std::optional<PhaseError> phase_;   // empty in statics
  double local_ = 0, stiffness_ = 0;  // largest LinearityError::displacement and LinearityError::stiffness so far
  double error_ = 0;                  // see error()
  bool unstable_ = false;
  std::string only_linear_;
};

// Message if LinearityWatch::unstable().
inline constexpr const char* kBucklesBelowLoads =
    "the body buckles below these loads, which linear kinematics do not show";

// "about 0.012 of the motion".
std::string linearity_error_text(double error, const char* format = "{:.3g}");
// Proposes another integrator. `only_linear`: type of the present one, which supports linear kinematics only.
std::string other_integrator(const std::string& only_linear);

// Describes the result of a completed run: "linear in arm: off by about 1.2e-03 of the motion, where 1.0e-02 is
// allowed".
std::string linearity_summary(const LinearityWatch& watch);

}  // namespace orthodyn
