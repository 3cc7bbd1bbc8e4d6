// A scene: the checked input of one simulation as plain data, in SI units.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/fem/mass.h"
#include "lib/fem/motion/support_motion.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/gravity.h"
#include "lib/fem/terms/load.h"
#include "lib/material/material.h"
#include "lib/mesh/mesh_source.h"
#include "lib/ode/integrator.h"
#include "lib/scene/activation.h"
#include "lib/scene/damping.h"
#include "lib/scene/elasticity.h"
#include "lib/scene/events.h"
#include "lib/scene/expectation.h"
#include "lib/scene/harmonic.h"
#include "lib/scene/initial.h"
#include "lib/scene/joint_input.h"
#include "lib/scene/output_files.h"
#include "lib/scene/places.h"
#include "lib/scene/region.h"
#include "lib/scene/state_change.h"
#include "lib/scene/tie_input.h"
#include "lib/statics/equilibrium.h"
#include "lib/statics/load_stepper.h"

namespace orthodyn {

enum class Analysis { dynamic, statical, buckling, harmonic };

template <>
struct EnumNames<Analysis> {
  static constexpr std::array<std::pair<Analysis, const char*>, 4> list{{{Analysis::dynamic, "dynamic"},
                                                                         {Analysis::statical, "static"},
                                                                         {Analysis::buckling, "buckling"},
                                                                         {Analysis::harmonic, "harmonic"}}};
};

// How a dynamic analysis starts: from the rest shape, or from the static equilibrium under the loads at the start.
enum class Start { rest, equilibrium };

// The section `time`.
struct TimeSpan {
  double start = 0, end = 0;  // s
  static const Spec<TimeSpan>& spec();
};

// An entry of the list `clamps`: nodes with fixed components.
struct Clamp : Selection {
  std::string name;
  std::vector<Component> components{Component::x, Component::y, Component::z};
  static const Spec<Clamp>& spec();
};

// The section `statics`: solver and load stepping of equilibria.
struct Statics : LoadStepping {
  std::shared_ptr<const EquilibriumChoice> solver;
  static const Spec<Statics>& spec();
};

// The section `buckling` (lib/analysis/buckling.h).
struct Buckling {
  int count = 6;
  static const Spec<Buckling>& spec();
};

// Paths of numbers of the scene (lib/simulation/sensitivity/scene_parameter.h).
struct ParameterPaths : std::vector<std::string> {
  using vector::vector;
  SourceLocation origin = {};
};
template <>
struct Value<ParameterPaths> {
  static ValueSchema schema() { return Value<std::vector<std::string>>::schema(); }
  static ParameterPaths read(const Config& c, const Rule& r);
  static std::string yaml(const ParameterPaths& x) { return Value<std::vector<std::string>>::yaml(x); }
};

inline constexpr Range kThreads{1, 1024};  // allowed values of `threads`

struct Scene {
  Analysis analysis = Analysis::dynamic;
  std::shared_ptr<const MeshSource> mesh;
  std::shared_ptr<const LoadedMesh> loaded;  // null unless the mesh was read for its materials
  Named<std::shared_ptr<const Material>> materials;
  Named<Region> regions;
  Elasticity elasticity;
  std::optional<MassKind> given_mass;  // empty: by the regions
  MassKind mass = MassKind::lumped;    // consistent with rigid regions
  std::optional<Damping> damping;
  std::optional<StateChange> moisture, temperature;
  std::optional<Activation> activation;
  std::optional<GravityChoice> gravity;
  std::vector<Load> loads;
  std::vector<std::shared_ptr<const TermChoice>> terms;
  std::vector<Clamp> clamps;
  std::vector<SupportMotion> motions;
  std::vector<JointInput> joints;
  std::vector<TieInput> ties;
  std::optional<Initial> initial;
  Start start = Start::rest;
  TimeSpan time;
  std::shared_ptr<const IntegratorChoice> integrator;  // null unless the analysis is dynamic
  std::optional<Statics> statics;                      // if the analysis is static or starts from equilibrium
  std::optional<Buckling> buckling;                    // for analysis: buckling
  std::optional<Harmonic> harmonic;                    // for analysis: harmonic
  std::vector<EventSpec> events;
  Output output;
  ParameterPaths sensitivities;
  std::optional<CheckpointSchedule> checkpoint;
  std::vector<Expectation> expect;
  std::optional<int> threads;  // empty: number of hardware threads (RunThreads)
  Places places;               // of the sections in the file, for errors found later

  static const Spec<Scene>& spec();

  // Whether the analysis has no time steps. Loads and supports are then evaluated at the end of the time span, in a
  // harmonic analysis at the times that stand for the parts of their amplitude (kRealPart).
  bool is_static() const { return analysis != Analysis::dynamic; }

  // All terms except elasticity, in the order of assembly: gravity, loads, terms.
  std::vector<const TermChoice*> force_terms() const;
};

// Reads and checks a scene; defaults are recorded if `input` is resolving(). Throws ConfigError.
Scene read_scene(const Config& input);

}  // namespace orthodyn
