// `elasticity.kinematics: auto`: linear kinematics where they are accurate enough, watched for as long as they are
// used.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lib/analysis/linearity.h"
#include "lib/scene/build.h"
#include "lib/simulation/observers/observer.h"

namespace orthodyn {

// Looks on at a run with linear kinematics, and ends it where they are off by more than is allowed: at the largest
// displacement so far, and by the phase that a vibration of this size gains or loses until now.
class LinearityWatch : public Observer {
 public:
  // `linear` must outlive it. The motion is from `start` to `end`, s; in statics `end` is infinite. `allowed`: of the
  // largest displacement. `only_linear`: the integrator, if it serves linear kinematics only; else "".
  LinearityWatch(const FemModel& linear, std::unique_ptr<FemModel> exact, double start, double end, double allowed,
                 std::string only_linear);

  void on_start(const ObservedState& observed) override { look_at(observed.state()); }
  void on_resume(const ObservedState& observed) override { look_at(observed.state()); }
  // Throws RunError where linear kinematics are outgrown.
  void on_output(const ObservedState& observed) override { look_at(observed.state()); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    look_at(observed.state());
  }

  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // Of one state, without phase.
  double error_at(double t, const Vector& q) const { return linearity_.error(t, q).displacement; }
  // Keeps it, as that of a state of the run.
  void note(double t, const Vector& q);
  // The same; throws RunError where linear kinematics are outgrown.
  void require(double t, const Vector& q);

  // In a sentence; "" if linear kinematics are not outgrown, or if the integrator serves no others.
  std::string why_to_start_again() const;

  double allowed() const { return allowed_; }
  double error() const { return error_; }  // the largest so far, phase included
  bool outgrown() const { return error_ > allowed_; }
  double time() const { return time_; }  // s: of the last state that was looked at

 private:
  void look_at(const State& state);
  void refuse_outgrown() const;
  double norm(const Vector& x) const;  // in the mass norm

  const FemModel& linear_;
  std::unique_ptr<FemModel> exact_;
  Linearity linearity_;
  double allowed_, start_ = 0, time_ = 0;
  double checked_ = 0;                        // the displacement at which the error was computed last
  double displacement_ = 0, velocity_ = 0;    // the largest so far
  double local_ = 0, stiffness_ = 0, error_ = 0;
  std::string only_linear_;
};

// What was taken for `auto`.
struct KinematicsChoice {
  bool linear = false;
  std::string reason;  // in words
};

struct ChosenKinematics {
  KinematicsChoice choice;
  BuiltScene built;                       // with what was taken
  std::unique_ptr<LinearityWatch> watch;  // null unless linear
};

// Sets `elasticity.kinematics` in a scene's document, without the `linear_error` that means nothing beside it.
void set_kinematics(Config& config, const std::string& kinematics);

// Builds a scene that says `auto`. Linear unless something of the scene is not, or its linear response is clearly too
// large. The document then says corotational, or `auto` still, with the error that is allowed: whoever goes on from it
// is to watch as well. `linear_so_far`: of a run that goes on with linear kinematics, nothing is predicted. Throws
// ConfigError, also where corotational ones are needed and the integrator serves linear ones only.
ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool linear_so_far = false);

// Calls `attempt` with the scene. Where it returns why linear kinematics were outgrown, calls it once more, with that
// sentence and corotational kinematics; the first time the sentence is "".
using KinematicsAttempt = std::function<std::string(Config scene, const std::string& outgrown)>;
void start_again_if_outgrown(const Config& scene, const KinematicsAttempt& attempt);

// What is told of a run with linear kinematics that has ended.
std::string outcome_of(const LinearityWatch& watch);
std::string outgrown_sentence(const LinearityWatch& watch);

}  // namespace orthodyn
