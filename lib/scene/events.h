// A scene's events, ready to be looked for.
#pragma once

#include <vector>

#include "lib/ode/event.h"
#include "lib/scene/scene.h"

namespace orthodyn {

class FemModel;

// Throws ConfigError for a quantity that the scene does not have or that is a vector. `model` must outlive them.
std::vector<Event> make_events(const Scene& scene, const FemModel& model);

}  // namespace orthodyn
