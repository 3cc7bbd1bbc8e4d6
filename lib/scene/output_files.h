// The sections `output`, with its probes and gauges, and `checkpoint`: what a run writes, and when.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/scene/gauge.h"

namespace orthodyn {

// interpolated: frames are taken from dense output. exact: steps end at frame times.
enum class OutputTimes { interpolated, exact };

// When energies are computed.
enum class EnergyTimes { outputs, steps };

// Names of node fields (for probes), and of node and cell fields (for frames).
struct NodeFields : std::vector<std::string> {
  using vector::vector;
};
struct FrameFields : std::vector<std::string> {
  using vector::vector;
  SourceLocation origin = {};  // empty for the default fields
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
  std::optional<std::string> region;
  NodeFields fields{"displacement"};
  SourceLocation origin;
  // The nearest node, of the region if there is one. Throws ConfigError for an unknown region.
  int node(const Mesh& mesh) const;
  static const Spec<Probe>& spec();
};

// When probes, gauges, reactions, energies and momenta are recorded, if not with the frames.
struct History {
  std::optional<double> interval;  // between rows, s
  bool steps = false;              // a row after each step
  static const Spec<History>& spec();
};

struct Output {
  std::optional<double> interval;  // between frames, s
  std::optional<int> frames;
  std::optional<History> history;  // empty: with the frames
  OutputTimes times = OutputTimes::interpolated;
  FrameFields fields{"displacement", "velocity"};
  Named<Probe> probes;
  Named<Gauge> gauges;                                 // written to probes.csv
  std::vector<std::string> extremes;                   // "von_mises.largest"
  bool reactions = false;                              // written to probes.csv
  bool energy = true, steps = true, momentum = false;  // files energy.csv, steps.csv, momentum.csv
  EnergyTimes energy_times = EnergyTimes::outputs;
  bool accumulated_error = true, mesh_error = true;  // whether these errors are estimated
  SourceLocation origin;
  static const Spec<Output>& spec();
};

// Throws ConfigError for names that a CSV file cannot have.
void require_name_for_csv(const std::string& name, const SourceLocation& origin);

// When the state is saved for `orthodyn run --resume`: as soon as one of the two limits is reached.
struct CheckpointSchedule {
  double every = 60;          // s of wall time
  std::optional<int> frames;  // save also after this number of frames
  static const Spec<CheckpointSchedule>& spec();
};

}  // namespace orthodyn
