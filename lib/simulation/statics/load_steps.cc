#include "lib/simulation/statics/load_steps.h"

#include <limits>

namespace orthodyn {

namespace {

std::vector<std::string> energies_of(const Model& model) {
  std::vector<std::string> names;
  for (const auto& info : model.outputs())
    if (info.name == "energy.elastic" || info.name == "energy.gravitational") names.push_back(info.name);
  return names;
}

std::vector<std::string> header(const std::vector<std::string>& energies) {
  std::vector<std::string> out{"load_factor", "newton_iterations", "residual [N]", "largest_displacement [m]",
                               "unstable_directions"};
  for (const auto& name : energies) out.push_back(name + " [J]");
  return out;
}

}  // namespace

Outcome run_static(const Model& model, LoadStepper& stepper, const std::vector<Observer*>& observers,
                   const std::atomic<bool>& interrupt) {
  return supervise(stepper.state(), observers, [&](Outcome& outcome) {
    const ObservedState start(model, outcome.last);
    for (auto* o : observers) o->on_start(start);
    while (!stepper.done()) {
      if (model.space().any(interrupt)) {
        outcome.status = Outcome::Status::interrupted;
        return;
      }
      stepper.step();
      outcome.last = stepper.state();
      const ObservedState equilibrium(model, outcome.last);
      for (auto* o : observers) o->on_history(equilibrium), o->on_output(equilibrium);
    }
  });
}

LoadStepWriter::LoadStepWriter(const std::filesystem::path& path, const Model& model, const LoadStepper& stepper)
    : stepper_(stepper), space_(model.space()), energies_(energies_of(model)), file_(path, header(energies_)) {}

void LoadStepWriter::on_start(const ObservedState& observed) {
  file_.begin();
  write(observed);
}

void LoadStepWriter::write(const ObservedState& observed) {
  const State& state = observed.state();
  const auto& attempt = stepper_.attempt();
  std::vector<double> row{state.t, static_cast<double>(attempt.iterations), attempt.residual,
                          space_.largest_entry(state.q),
                          stepper_.unstable() ? *stepper_.unstable() : std::numeric_limits<double>::quiet_NaN()};
  for (const auto& name : energies_) row.push_back(observed.evaluate(name)[0]);
  file_.row(row);
}

}  // namespace orthodyn
