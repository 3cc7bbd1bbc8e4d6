// A scene: everything that one simulation consists of, checked, as plain data. SI units.
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
#include "lib/scene/clamp.h"
#include "lib/scene/damping.h"
#include "lib/scene/elasticity.h"
#include "lib/scene/events.h"
#include "lib/scene/expectation.h"
#include "lib/scene/initial.h"
#include "lib/scene/output_files.h"
#include "lib/scene/places.h"
#include "lib/scene/region.h"
#include "lib/scene/static_analysis.h"
#include "lib/scene/time_span.h"

namespace orthodyn {

enum class Analysis { dynamic, statical, buckling };
enum class Start { rest, equilibrium };

// Linear buckling (lib/analysis/buckling.h).
struct Buckling {
  int count = 6;
  static const Spec<Buckling>& spec();
};

inline constexpr Range kThreads{1, 1024};

struct Scene {
  Analysis analysis = Analysis::dynamic;
  std::shared_ptr<const MeshSource> mesh;
  std::shared_ptr<const LoadedMesh> loaded;  // where the mesh had to be read for its materials already
  Named<std::shared_ptr<const Material>> materials;
  Named<Region> regions;
  Elasticity elasticity;
  MassKind mass = MassKind::lumped;
  std::optional<Damping> damping;
  std::optional<GravityChoice> gravity;
  std::vector<Load> loads;
  std::vector<std::shared_ptr<const TermChoice>> terms;
  std::vector<Clamp> clamps;
  std::vector<SupportMotion> motions;
  std::optional<Initial> initial;
  Start start = Start::rest;
  TimeSpan time;
  std::shared_ptr<const IntegratorChoice> integrator;  // null in statics
  std::optional<Statics> statics;                      // of a static analysis and a start from equilibrium
  std::optional<Buckling> buckling;                    // of a buckling analysis
  std::vector<EventSpec> events;
  Output output;
  std::optional<CheckpointSchedule> checkpoint;
  std::vector<Expectation> expect;
  std::optional<int> threads;  // of a run; none: as many as the machine has (RunThreads)
  Places places;

  static const Spec<Scene>& spec();

  // Nothing moves: loads and supports are as at the end of the time span.
  bool is_static() const { return analysis != Analysis::dynamic; }

  // What exerts forces beside elasticity, in the order in which they are added: gravity, loads, terms.
  std::vector<const TermChoice*> force_terms() const;
};

// Reads a scene; a resolving() input records its defaults. Throws ConfigError.
Scene read_scene(const Config& input);

}  // namespace orthodyn
