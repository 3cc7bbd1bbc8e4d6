// A scene: everything that one simulation consists of, checked, as plain data. SI units.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/formula.h"
#include "lib/config/registry.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/fem/mass.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/material/material.h"
#include "lib/ode/integrator.h"
#include "lib/axes/axes_source.h"
#include "lib/scene/event_spec.h"
#include "lib/scene/expectation.h"
#include "lib/scene/mesh_source.h"
#include "lib/scene/statics.h"
#include "lib/scene/support_motion.h"
#include "lib/scene/term_choice.h"

namespace orthodyn {

enum class OutputTimes { interpolated, exact };
enum class Analysis { dynamic, statical };
enum class Start { rest, equilibrium };

struct Clamp : Selection {
  std::string name;
  std::vector<Component> components{Component::x, Component::y, Component::z};
  static const Spec<Clamp>& spec();
};

struct Load {
  std::string surface;
  std::optional<Vec3> traction;  // Pa, per undeformed area
  std::optional<Vec3> force;     // N in total, spread evenly over the area
  std::shared_ptr<const TimeFunction> factor;
  Origin origin;
  static const Spec<Load>& spec();
};

struct Damping {
  double mass = 0;       // 1/s
  double stiffness = 0;  // s
  static const Spec<Damping>& spec();
};

struct Region {
  std::string material;
  std::shared_ptr<const AxesSource> axes;
  std::optional<double> stiffness_damping;  // s; overrides damping.stiffness
  Origin origin;
  static const Spec<Region>& spec();
};

struct Elasticity : ElasticityOptions {
  static const Spec<Elasticity>& spec();
};

struct Noise {
  double amplitude = 0;  // m
  long seed = 1;
  static const Spec<Noise>& spec();
};

struct Initial {
  Vec3 velocity = Vec3::Zero();                // m/s
  Vec3 spin = Vec3::Zero();                    // rad/s
  std::optional<std::array<PointFormula, 3>> velocity_field;  // m/s, of the rest position
  std::optional<Vec3> center;                  // m; default the centre of mass
  std::optional<Mat3> deformation_gradient;    // about the centre
  std::optional<std::array<PointFormula, 3>> displacement_field;  // m, of the rest position
  std::optional<Noise> noise;
  static const Spec<Initial>& spec();
};

struct TimeSpan {
  double start = 0, end = 0;  // s
  static const Spec<TimeSpan>& spec();
};

struct Probe {
  Vec3 at = Vec3::Zero();  // m, in the rest shape
  std::vector<std::string> fields{"displacement"};
  Origin origin;
  static const Spec<Probe>& spec();
};

struct Output {
  std::optional<double> interval;  // s
  std::optional<int> frames;
  OutputTimes times = OutputTimes::interpolated;
  std::vector<std::string> fields{"displacement", "velocity"};
  Named<Probe> probes;
  bool reactions = false, energy = true, steps = true, momentum = false;
  Origin origin;
  static const Spec<Output>& spec();
};

// When the state is kept for `orthodyn run --resume`: whichever comes first.
struct CheckpointSchedule {
  double every = 60;          // s of wall time
  std::optional<int> frames;  // after so many frames
  static const Spec<CheckpointSchedule>& spec();
};

struct Scene {
  Analysis analysis = Analysis::dynamic;
  std::shared_ptr<const MeshSource> mesh;
  std::shared_ptr<const LoadedMesh> loaded;  // where the mesh had to be read for its materials already
  Named<std::shared_ptr<const Material>> materials;
  Named<Region> regions;
  Elasticity elasticity;
  MassKind mass = MassKind::lumped;
  std::optional<Damping> damping;
  std::optional<Vec3> gravity;  // m/s^2
  std::vector<Load> loads;
  std::vector<std::shared_ptr<const TermChoice>> terms;
  std::vector<Clamp> clamps;
  std::vector<SupportMotion> motions;
  std::optional<Initial> initial;
  Start start = Start::rest;
  TimeSpan time;
  std::shared_ptr<const IntegratorChoice> integrator;  // null in statics
  std::optional<Statics> statics;  // of a static analysis and a start from equilibrium
  std::vector<EventSpec> events;
  Output output;
  std::optional<CheckpointSchedule> checkpoint;
  std::vector<Expectation> expect;

  static const Spec<Scene>& spec();
};

// Reads a scene and fills its defaults into `config`. Throws ConfigError.
Scene read_scene(const Config& config);

}  // namespace orthodyn
