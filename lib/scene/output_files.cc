#include "lib/scene/output_files.h"

namespace orthodyn {

template <>
struct Words<OutputTimes> {
  static constexpr std::array<std::pair<OutputTimes, const char*>, 2> list{
      {{OutputTimes::interpolated, "interpolated"}, {OutputTimes::exact, "exact"}}};
};

template <>
struct Words<EnergyTimes> {
  static constexpr std::array<std::pair<EnergyTimes, const char*>, 2> list{
      {{EnergyTimes::outputs, "outputs"}, {EnergyTimes::steps, "steps"}}};
};

const Spec<Probe>& Probe::spec() {
  static const auto s =
      Spec<Probe>()
          .key("at", &Probe::at, "The node nearest to this point of the rest shape.",
               {.required = true, .unit = "m"})
          .key("fields", &Probe::fields, "Node fields to record.");
  return s;
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
               {.range = {0, 1e6}})
          .key("history", &Output::history,
               "When probes.csv, energy.csv and momentum.csv get their rows; default with the frames.")
          .key("times", &Output::times,
               "interpolated: frames from the integrator's own polynomial; exact: steps end on them.")
          .key("fields", &Output::fields, "Node and cell fields of the frames (see `orthodyn list fields`).")
          .key("probes", &Output::probes, "Named points whose fields go to probes.csv.")
          .key("reactions", &Output::reactions,
               "Record force and torque of every clamp and motion on the body in probes.csv.")
          .key("energy", &Output::energy, "Write energy.csv.")
          .key("accumulated_error", &Output::accumulated_error,
               "Tell after runs of some 500 steps and more how far the errors of the steps may have added up, by "
               "integrating a "
               "few short parts again; costs some per cent.")
          .key("mesh_error", &Output::mesh_error,
               "Tell how far off the mesh may be, from stresses recovered at the nodes, at some of the outputs.")
          .key("energy_times", &Output::energy_times,
               "outputs: energies are computed for the rows of energy.csv; steps: after each step, too, and the drift "
               "of the summary is over all of them. It costs about one evaluation of the forces a step.")
          .key("steps", &Output::steps, "Write steps.csv.")
          .key("momentum", &Output::momentum, "Write momentum.csv.")
          .check([](const Output& output, const Config& config) {
            if (output.interval && output.frames) config.fail("give one of interval, frames");
            for (const auto& [name, probe] : output.probes)
              if (name.find_first_of(",\"\r\n") != std::string::npos)
                probe.origin.fail("its name goes into a CSV file: no commas, quotes or line breaks");
          });
  return s;
}

const Spec<CheckpointSchedule>& CheckpointSchedule::spec() {
  static const auto s =
      Spec<CheckpointSchedule>()
          .key("every", &CheckpointSchedule::every, "Wall time between checkpoints.", {.unit = "s", .range = kPositive})
          .key("frames", &CheckpointSchedule::frames, "Also after every so many frames.", {.range = {1, 1e6}});
  return s;
}

}  // namespace orthodyn
