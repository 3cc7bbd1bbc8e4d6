#include "lib/simulation/run/several_ranks.h"

#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/run/kinematics.h"

namespace orthodyn {

void adapt_to_ranks(Config& config, Scene& scene) {
  if (scene.analysis == Analysis::buckling || scene.analysis == Analysis::harmonic)
    config.at("analysis")
        .fail(Value<Analysis>::yaml(scene.analysis) + ": this analysis runs in one process, not on several ranks");
  if (scene.analysis == Analysis::dynamic && !scene.integrator->runs_on_ranks()) {
    std::vector<std::string> names;
    for (const auto& [name, entry] : Registry<IntegratorChoice>::entries())
      if (entry.make()->runs_on_ranks()) names.push_back(name);
    const Config type = config.at("integrator").at("type");
    type.fail("'" + type.text() + "' does not run on several ranks; those that do: " + join(names));
  }
  if (leaves_kinematics_open(scene)) {
    make_corotational(config);
    scene = read_scene(config);
  }
  scene.output.accumulated_error = false;  // the estimate would repeat parts of the run
}

int num_ranks(const Ranks* ranks) { return ranks ? ranks->size() : 1; }

bool only_this_rank_failed(const Ranks* ranks) {
  constexpr double kSecondsToMeet = 10;
  return ranks && !ranks->barrier_within(kSecondsToMeet);
}

void require_failure_of_all(const Ranks* ranks, const Outcome& outcome) {
  if (outcome.status == Outcome::Status::failed && only_this_rank_failed(ranks))
    throw std::runtime_error(outcome.message);
}

}  // namespace orthodyn
