#include "lib/simulation/output/run_observers.h"

#include <fmt/format.h>

#include "lib/fem/contact/contact.h"

namespace orthodyn {

namespace {

// Forces of supports, joints, ties and contacts, and the coordinates of joints.
std::vector<std::string> reactions_of(const FemModel::Parts& parts) {
  std::vector<std::string> names;
  for (const Support& support : parts.supports)
    for (const char* what : {"reaction.", "torque."}) names.push_back(what + support.name);
  for (const Joint& joint : parts.joints) {
    if (joint.of == Joint::Of::rigid_body) continue;
    if (joint.holds()) names.push_back("joint." + joint.name);
    if (joint.bears_torque()) names.push_back("joint_torque." + joint.name);
    if (joint.coordinate) names.push_back("coordinate." + joint.name);
    if (joint.slide && joint.coordinate->is_angle()) names.push_back("slide." + joint.name);
    if (joint.angle && !joint.coordinate->is_angle()) names.push_back("angle." + joint.name);
    if (joint.motor()) names.push_back("motor." + joint.name);
  }
  for (const NamedTie& tie : parts.ties) names.push_back("tie." + tie.name);
  for (const auto& [name, contact] : parts.contacts)
    if (contact->has_resultant()) names.push_back("contact." + name);
  return names;
}

std::vector<std::string> sprung_hinges(const Scene& scene) {
  std::vector<std::string> names;
  for (const JointInput& joint : scene.joints)
    if (joint.turns() && (joint.spring || joint.stop)) names.push_back(joint.name);
  return names;
}

}  // namespace

std::vector<ProbeColumn> probe_columns(const Scene& scene, const FemModel& model) {
  std::vector<ProbeColumn> columns;
  for (const auto& [name, probe] : scene.output.probes)
    for (const auto& field : probe.fields) columns.push_back({name, probe.node(model.parts().mesh), field});
  for (const auto& [name, gauge] : scene.output.gauges)
    columns.push_back({name, 0, "", PlacedGauge(gauge, model.parts().mesh)});
  if (scene.output.reactions)
    for (const std::string& name : reactions_of(model.parts())) columns.push_back({"", 0, name});
  return columns;
}

RunObservers::RunObservers(const Setup& setup, const std::filesystem::path& folder)
    : linearity_(setup.linearity.get()), finder_(setup.events) {
  const auto& model = *setup.built.model;
  const auto& scene = setup.scene;
  if (!scene.output.fields.empty()) {
    frames_.emplace(folder, model, scene.output.fields, &model.parts().mesh);
    setup_.emplace(folder, setup);
  }
  if (const auto& output = scene.output; output.energy)  // without outputs, the drift is evaluated at steps
    energy.emplace(folder / "energy.csv", model, *setup.integrator,
                   output.frames == 0 && !output.history ? EnergyTimes::steps : output.energy_times);
  if (scene.output.momentum) momentum.emplace(folder / "momentum.csv");
  if (scene.output.steps) steps_.emplace(folder / "steps.csv");
  if (const auto columns = probe_columns(scene, model); !columns.empty())
    probes_.emplace(folder / "probes.csv", model, columns);
  if (!scene.output.extremes.empty()) extremes.emplace(scene, model);
  if (setup.sensitivities) observe_sensitivities(setup, folder);
  if (has_strain_limits(model)) strains.emplace(StrainWatch::of_motion(model, scene.time.end - scene.time.start));
  if (model.constraints()) joints.emplace(sprung_hinges(scene));
  if (!model.parts().contacts.empty()) contacts.emplace(model);
  if (!finder_.empty()) events_.emplace(folder / "events.csv", finder_);
}

void RunObservers::observe_sensitivities(const Setup& setup, const std::filesystem::path& folder) {
  const FemModel& model = *setup.built.model;
  sensitivities_.emplace(folder / "sensitivities.csv", setup.scene, model, *setup.integrator, *setup.sensitivities);
  slopes_.emplace(*setup.integrator, *setup.sensitivities);
  if (extremes) extremes->differentiate(*slopes_);
  if (!finder_.empty()) event_sensitivities_.emplace(folder / kEventSensitivities, setup.scene, model, *slopes_);
}

NamedObservers RunObservers::checkpointed() {
  NamedObservers out{{"inversion", &inversion}};
  const auto add = [&](const char* name, auto& observer) {
    if (observer) out.emplace_back(name, &*observer);
  };
  add("frames", frames_);
  add("energy", energy);
  add("momentum", momentum);
  add("steps", steps_);
  add("probes", probes_);
  add("sensitivities", sensitivities_);
  add("events", events_);
  add("event_sensitivities", event_sensitivities_);
  add("extremes", extremes);
  add("strains", strains);
  add("joints", joints);
  add("contacts", contacts);
  add("linearity", linearity_);
  return out;
}

std::vector<Observer*> RunObservers::all(Observer* progress, Checkpointer& checkpointer) {
  std::vector<Observer*> out;
  if (progress) out.push_back(progress);  // called first; the writers can reuse the values it evaluates
  for (const auto& [name, observer] : checkpointed()) out.push_back(observer);
  if (setup_) out.push_back(&*setup_);
  out.push_back(&checkpointer);
  return out;
}

void RunObservers::restore(const Checkpoint& checkpoint) {
  for (const auto& [name, observer] : checkpointed()) {
    const auto found = checkpoint.observers.find(name);
    if (found == checkpoint.observers.end())
      throw ConfigError(
          fmt::format("checkpoint: has no entry for '{}'; start anew with --force instead of --resume", name));
    observer->restore(found->second);
  }
}

}  // namespace orthodyn
