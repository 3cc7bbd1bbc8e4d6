// What a run writes, and when: the sections `output`, with its probes, and `checkpoint`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"

namespace orthodyn {

enum class OutputTimes { interpolated, exact };

// When energies are computed.
enum class EnergyTimes { outputs, steps };

// Names of fields per node, and of those that frames may have: per node and per cell.
struct NodeFields : std::vector<std::string> {
  using vector::vector;
};
struct FrameFields : std::vector<std::string> {
  using vector::vector;
  SourceLocation origin = {};  // "" of default ones
};

template <>
struct Value<NodeFields> {
  static ValueSchema schema();
  static NodeFields read(const Config& c, const Rule& r);
  static std::string yaml(const NodeFields& x) { return Value<std::vector<std::string>>::yaml(x); }
};
template <>
struct Value<FrameFields> {
  static ValueSchema schema();
  static FrameFields read(const Config& c, const Rule& r);
  static std::string yaml(const FrameFields& x) { return Value<std::vector<std::string>>::yaml(x); }
};

// A point whose fields go to probes.csv.
struct Probe {
  Vec3 at = Vec3::Zero();  // m, in the rest shape
  NodeFields fields{"displacement"};
  SourceLocation origin;
  static const Spec<Probe>& spec();
};

// When probes, reactions, energies and momenta are recorded, apart from the frames.
struct History {
  std::optional<double> interval;  // s
  bool steps = false;              // after each step
  static const Spec<History>& spec();
};

struct Output {
  std::optional<double> interval;  // s
  std::optional<int> frames;
  std::optional<History> history;  // absent: with the frames
  OutputTimes times = OutputTimes::interpolated;
  FrameFields fields{"displacement", "velocity"};
  Named<Probe> probes;
  std::vector<std::string> extremes;
  bool reactions = false, energy = true, steps = true, momentum = false;
  EnergyTimes energy_times = EnergyTimes::outputs;
  bool accumulated_error = true, mesh_error = true;
  SourceLocation origin;
  static const Spec<Output>& spec();
};

// When the state is kept for `orthodyn run --resume`: whichever comes first.
struct CheckpointSchedule {
  double every = 60;          // s of wall time
  std::optional<int> frames;  // after so many frames
  static const Spec<CheckpointSchedule>& spec();
};

}  // namespace orthodyn
