#include "lib/scene/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_fields.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

template <>
struct EnumNames<OutputTimes> {
  static constexpr std::array<std::pair<OutputTimes, const char*>, 2> list{
      {{OutputTimes::interpolated, "interpolated"}, {OutputTimes::exact, "exact"}}};
};

template <>
struct EnumNames<EnergyTimes> {
  static constexpr std::array<std::pair<EnergyTimes, const char*>, 2> list{
      {{EnergyTimes::outputs, "outputs"}, {EnergyTimes::steps, "steps"}}};
};

namespace {

// The names are checked later, when the model is built, which allows better messages.
template <class Names>
Names read_names(const Config& c, const Rule& r) {
  Names out;
  for (auto& name : Value<std::vector<std::string>>::read(c, r)) out.push_back(std::move(name));
  return out;
}

// Refuses cell fields that exist at nodes under another name, such as nodal_stress.
void refuse_cell_fields(const Config& c, const NodeFields& names) {
  const auto all = FemModel(FemModel::Parts{}).outputs();
  const auto is_known = [&](const std::string& name, Location location) {
    return std::ranges::any_of(all, [&](const auto& info) { return info.name == name && info.location == location; });
  };
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_known(names[i], Location::cell) && is_known("nodal_" + names[i], Location::node))
      c.at(i).fail(fmt::format("'{0}' is a cell field, but probes are at nodes; did you mean 'nodal_{0}'?", names[i]));
}

// The schema allows the model's outputs at these locations, and the names in `more`.
ValueSchema schema_of_names(const std::vector<Location>& locations, std::vector<std::string> more = {}) {
  ValueSchema name{.kind = ValueSchema::Kind::word, .names = std::move(more)};
  for (const auto& info : FemModel(FemModel::Parts{}).outputs())
    if (std::find(locations.begin(), locations.end(), info.location) != locations.end())
      name.names.push_back(info.name);
  ValueSchema in_region{.kind = ValueSchema::Kind::word, .words = "REGION.FIELD", .behind_name = true};
  for (const auto& info : region_fields()) in_region.names.push_back(info.name);
  return list_schema({.kind = ValueSchema::Kind::either, .items = {std::move(name), std::move(in_region)}}, 0,
                     "list of fields");
}

}  // namespace

void require_name_for_csv(const std::string& name, const SourceLocation& origin) {
  if (name.find_first_of(",\"\r\n") != std::string::npos)
    origin.fail("its name is written to a CSV file: it must not contain commas, quotes or line breaks");
}

// A harmonic analysis also has accelerations.
ValueSchema Value<NodeFields>::schema() { return schema_of_names({Location::node}, {"acceleration"}); }
NodeFields Value<NodeFields>::read(const Config& c, const Rule& r) {
  NodeFields names = read_names<NodeFields>(c, r);
  refuse_cell_fields(c, names);
  return names;
}

ValueSchema Value<FrameFields>::schema() { return schema_of_names({Location::node, Location::cell}); }
FrameFields Value<FrameFields>::read(const Config& c, const Rule& r) {
  FrameFields names = read_names<FrameFields>(c, r);
  names.origin = {c.where()};
  return names;
}

const Spec<Probe>& Probe::spec() {
  static const auto s =
      Spec<Probe>()
          .key("at", &Probe::at, "The node nearest to this point of the rest shape.", {.required = true, .unit = "m"})
          .key("region", &Probe::region, "Its nodes only, where bodies have nodes at one place; default: all nodes.")
          .key("fields", &Probe::fields,
               "Node fields to record; for stress and strain also REGION.FIELD, which gives the value in one region at "
               "a node of several.");
  return s;
}

int Probe::node(const Mesh& mesh) const {
  if (!region) return nearest_node(mesh, at);
  Selection nodes;
  nodes.region = region;
  nodes.origin = origin;
  const std::vector<int> own = selected_nodes(nodes, mesh);
  return *std::min_element(own.begin(), own.end(), [&](int a, int b) {
    return (mesh.node(a) - at).squaredNorm() < (mesh.node(b) - at).squaredNorm();
  });
}

const Spec<History>& History::spec() {
  static const auto s =
      Spec<History>()
          .key("interval", &History::interval, "Time between rows.", {.unit = "s", .range = kPositive})
          .key("steps", &History::steps, "A row after each step.")
          .check([](const History& history, const Config& config) {
            if (history.interval.has_value() == history.steps) config.fail("give one of interval, steps: true");
          });
  return s;
}

const Spec<Output>& Output::spec() {
  static const auto s =
      Spec<Output>()
          .key("interval", &Output::interval, "Time between frames.", {.unit = "s", .range = kPositive})
          .key("frames", &Output::frames, "Frames after the initial one, evenly spaced; default 50.",
               {.range = {0, 1e9}})
          .key("history", &Output::history,
               "When rows are written to probes.csv, energy.csv and momentum.csv; default: with the frames.")
          .key("times", &Output::times,
               "interpolated: frames from the integrator's own polynomial; exact: steps end at frame times.")
          .key("fields", &Output::fields, "Node and cell fields of the frames (see `orthodyn list fields`).")
          .key("probes", &Output::probes, "Named points whose fields go to probes.csv.")
          .key("gauges", &Output::gauges,
               "Named strain gauges, each between two points of the body: NAME.length and NAME.strain, the engineering "
               "strain, go to probes.csv.")
          .key("extremes", &Output::extremes,
               "Extremes of stress and strain over the run, with place and time, in the summary and run.json: "
               "von_mises.largest, tsai_wu.largest, REGION.nodal_stress_material.11.smallest; or of a probe: "
               "PROBE.displacement.z.largest. Those of a probe are found between all steps, others at the rows of "
               "the history.")
          .key(
              "reactions", &Output::reactions,
              "Record in probes.csv the force and torque that every clamp and motion exerts on the body, the forces of "
              "joints, motors, ties and contacts, and the coordinates of joints.")
          .key("energy", &Output::energy, "Write energy.csv.")
          .key("accumulated_error", &Output::accumulated_error,
               "After runs of about 500 steps or more, estimate the accumulated error of the steps by integrating a "
               "few short parts again; costs a few per cent.")
          .key("mesh_error", &Output::mesh_error,
               "Estimate the discretisation error: by a finer mesh in the state with the largest deformation, if that "
               "mesh has up to 120,000 unknowns; otherwise from recovered nodal stresses at some of the outputs.")
          .key("energy_times", &Output::energy_times,
               "outputs: energies are computed for the rows of energy.csv; steps: also after each step, and the drift "
               "in the summary covers all steps. Costs about one force evaluation per step.")
          .key("steps", &Output::steps, "Write steps.csv.")
          .key("momentum", &Output::momentum, "Write momentum.csv.")
          .check([](const Output& output, const Config& config) {
            if (output.interval && output.frames) config.fail("give one of interval, frames");
            for (const auto& [name, probe] : output.probes) require_name_for_csv(name, probe.origin);
            for (const auto& [name, gauge] : output.gauges) {
              require_name_for_csv(name, gauge.origin);
              const auto has_name = [&name = name](const auto& probe) { return probe.first == name; };
              if (std::ranges::any_of(output.probes, has_name))
                gauge.origin.fail("a probe has the same name; choose another one");
            }
          });
  return s;
}

const Spec<CheckpointSchedule>& CheckpointSchedule::spec() {
  static const auto s =
      Spec<CheckpointSchedule>()
          .key("every", &CheckpointSchedule::every, "Wall time between checkpoints.", {.unit = "s", .range = kPositive})
          .key("frames", &CheckpointSchedule::frames, "Also after this number of frames.", {.range = {1, 1e6}});
  return s;
}

}  // namespace orthodyn
