// `kinematics: auto`: linear kinematics where they are accurate enough, region by region, watched for as long as they
// are used.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/analysis/linearity.h"
#include "lib/scene/build.h"
#include "lib/simulation/error_estimate/linear_phase_error.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// An entry of the scene's `regions` with linear kinematics, and the elastic terms that it describes.
struct LinearRegion {
  std::string name;
  Linearity::Terms terms;
};

// Why a run with linear kinematics is to start again, and in which entries of `regions` with corotational ones.
struct Outgrown {
  std::vector<std::string> regions;
  std::string why;  // a sentence
};

// Looks on at a run with linear kinematics, and ends it where they are off by more than is allowed: at the largest
// displacement so far, and by the phase that a vibration of this size gains or loses until now.
class LinearityWatch : public Observer {
 public:
  // `model` must outlive it. The motion is from `start` to `end`, s; in statics `end` is infinite. `allowed`: of the
  // largest displacement; infinite to be told at the end only. `only_linear`: the integrator, if it serves linear
  // kinematics only; else "".
  LinearityWatch(const FemModel& model, std::vector<LinearRegion> regions, double start, double end, double allowed,
                 std::string only_linear = "");

  void on_start(const ObservedState& observed) override { look_at(observed.state()); }
  void on_resume(const ObservedState& observed) override { look_at(observed.state()); }
  // Throws RunError where linear kinematics are outgrown.
  void on_output(const ObservedState& observed) override { look_at(observed.state()); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    look_at(observed.state());
  }

  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // The error of one state, without phase. Throws RunError if the tangent at rest cannot be factorised.
  LinearityError error_at(double t, const Vector& q) { return linearity().error(t, q); }
  // At the end, for error(), which is NaN where it cannot be computed: the displacement may have grown since the last
  // look. In statics it is the last one.
  void finish();
  void finish_at(double t, const Vector& q);
  // The latter; throws RunError where linear kinematics are outgrown.
  void require(double t, const Vector& q);

  const std::vector<LinearRegion>& regions() const { return regions_; }
  std::size_t num_regions() const { return model_.parts().elastic.size(); }  // of the mesh, linear or not
  double allowed() const { return allowed_; }
  double error() const { return error_; }      // the largest so far, phase included
  bool unstable() const { return unstable_; }  // in statics: as LinearityError has it
  bool outgrown() const { return error_ > allowed_; }
  double time() const { return time_; }  // s: of the last state that was looked at

  // The regions that are to be corotational for what was found at a state: all but those which together are off by less
  // than half of what is allowed.
  std::vector<std::string> to_give_up(double t, const Vector& q);
  // None if linear kinematics are not outgrown, or if the integrator serves no others.
  std::optional<Outgrown> why_to_start_again();

 private:
  struct Largest {
    double t = 0, norm = 0;  // s; in the mass norm
    Vector q = {};
  };

  void look_at(const State& state);
  void refuse_outgrown() const;
  void note(double t, const Vector& q);  // the error there
  double next_look() const;              // the displacement from which on the error has to be computed anew
  double norm(const Vector& x) const;    // in the mass norm
  void take_in_phase();
  double share(double phase) const;         // of the motion, what has added up in a vibration
  double phase_of(double stiffness) const;  // of that, by terms that are off so far
  Linearity& linearity();

  const FemModel& model_;
  std::vector<LinearRegion> regions_;
  std::optional<Linearity> linearity_;  // made when it is needed first
  double allowed_, start_, span_, time_;
  Largest largest_;
  double checked_ = 0;               // the displacement at which the error was computed last
  std::optional<PhaseError> phase_;  // none in statics
  double local_ = 0, stiffness_ = 0, error_ = 0;
  bool unstable_ = false;
  std::string only_linear_;
};

// What was taken for `auto`.
struct KinematicsChoice {
  bool linear = false;  // in every region that leaves it open
  std::string reason;   // of what is not, in words
  void add_reason(const std::string& more) { reason += (reason.empty() ? "" : "; ") + more; }
};

struct ChosenKinematics {
  KinematicsChoice choice;
  BuiltScene built;                       // with what was taken
  std::unique_ptr<LinearityWatch> watch;  // null unless some region is linear by this choice
};

// Whether a scene leaves the kinematics of a region open.
bool leaves_kinematics_open(const Scene& scene);

// Whether a region of it has linear kinematics by its document.
bool is_linear_anywhere(const Scene& scene);

// Makes all regions corotational whose kinematics a scene's document leaves open.
void make_corotational(Config& config);

// Builds a scene that leaves kinematics open. Linear in all regions unless the linear response is clearly too large in
// some. The document then says corotational of these, and auto still of the others, with the error that is allowed:
// whoever goes on from it is to watch as well. `linear_so_far`: of a run that goes on with linear kinematics, nothing
// is predicted. Throws ConfigError, also where corotational ones are needed and the integrator serves linear ones only.
ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool linear_so_far = false);

// Calls `attempt` with the scene, and again for as long as it returns why linear kinematics were outgrown: with
// corotational ones where they were, and what has been given up in words; the first time that is "".
using KinematicsAttempt = std::function<std::optional<Outgrown>(Config scene, const std::string& given_up)>;
void start_again_if_outgrown(const Config& scene, const KinematicsAttempt& attempt);

// Of a scene whose user has chosen linear kinematics, for some region or all: to tell at the end what they cost. Null
// without, and for very large models.
std::unique_ptr<LinearityWatch> watch_for_the_end(const Scene& scene, const FemModel& model);

// What is told of a run with linear kinematics that has ended.
std::string outcome_of(const LinearityWatch& watch);
std::string outgrown_sentence(const LinearityWatch& watch);

}  // namespace orthodyn
