#include "lib/simulation/several_ranks.h"

#include "lib/core/words.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/kinematics.h"

namespace orthodyn {

void require_to_run_on_ranks(Config& config, Scene& scene) {
  if (scene.analysis != Analysis::dynamic)
    config.at("analysis").fail("only dynamic analyses run on several ranks; run this one without mpirun");
  if (scene.start == Start::equilibrium)
    config.at("start").fail("equilibrium is not found on several ranks; start at rest, or run without mpirun");
  if (!scene.integrator->runs_on_ranks()) {
    std::vector<std::string> names;
    for (const auto& [name, entry] : Registry<IntegratorChoice>::entries())
      if (entry.make()->runs_on_ranks()) names.push_back(name);
    config.at("integrator").at("type").fail("does not run on several ranks; those that do: " + join(names));
  }
  if (leaves_kinematics_open(scene)) {
    make_corotational(config);
    scene = read_scene(config);
  }
  scene.output.accumulated_error = false;  // it repeats parts of the run
}

}  // namespace orthodyn
