// `kinematics: auto`: chooses linear kinematics for each region where they are accurate enough. A LinearityWatch checks
// them during the run.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lib/scene/build.h"
#include "lib/simulation/error_estimate/linearity_watch.h"

namespace orthodyn {

// The decision for `auto`.
struct KinematicsChoice {
  bool linear = false;  // true if all regions with `auto` become linear
  std::string reason;   // why some become corotational, in words
  void add_reason(const std::string& more) { reason += (reason.empty() ? "" : "; ") + more; }
};

struct ChosenKinematics {
  KinematicsChoice choice;
  BuiltScene built;                       // built with the chosen kinematics
  std::unique_ptr<LinearityWatch> watch;  // null if no region became linear by this choice
};

// True if the kinematics of any region are `auto`.
bool leaves_kinematics_open(const Scene& scene);

// True if any region has `kinematics: linear`.
bool has_linear_region(const Scene& scene);

// Changes `auto` to `corotational` in the document, for all regions.
void make_corotational(Config& config);

// A copy of the document in which `linear` replaces `auto`. Precondition: choose_kinematics() has changed the document,
// so that the regions it left at `auto` have linear kinematics.
Config with_chosen_kinematics(const Config& config);

// Builds a scene with `auto` kinematics. Regions with `auto` become linear, except those for which the linear static
// response predicts a clearly larger error than allowed. In a buckling or harmonic analysis all become
// corotational. The document
// is changed accordingly: rejected regions become `corotational`; accepted ones stay `auto`, with the allowed error in
// elasticity.linear_error, so that a resumed run watches them, too. `resumes_linear`: the run resumes with linear
// kinematics, so that no error is predicted. Throws ConfigError, also if corotational kinematics are needed and the
// integrator supports linear ones only.
ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool resumes_linear = false);

// Calls `attempt` with the scene, and repeats it with corotational kinematics in more regions as long as it returns a
// KinematicsRestart. `restart_reason`: why earlier attempts were abandoned; "" at first.
using KinematicsAttempt =
    std::function<std::optional<KinematicsRestart>(Config scene, const std::string& restart_reason)>;
void run_with_kinematics_restarts(const Config& scene, const KinematicsAttempt& attempt);

// A watch without a limit, which reports the error of regions with `kinematics: linear` at the end of the run. Null if
// there are no such regions, and above 200,000 unknowns.
std::unique_ptr<LinearityWatch> reporting_watch(const Scene& scene, const FemModel& model);

}  // namespace orthodyn
