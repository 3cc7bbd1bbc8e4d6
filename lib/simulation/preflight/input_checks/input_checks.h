// Slips of unit and magnitude: figures of a scene that can be computed with, but are hardly meant. Each is a warning
// that names the place, what is found, and the slip that is most likely; no figure here changes what is computed.
//
// Most rules compare figures of the scene with each other (a wave with the body, a ramp with the run), so that scenes
// without dimensions pass; the others are bounds that no solid passes.
#pragma once

#include "lib/analysis/static_response.h"
#include "lib/config/config.h"
#include "lib/scene/build.h"

namespace orthodyn {

// `config` is the resolved input of the scene. `is_timed`: whether the user gave its time span.
Warnings check_inputs(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed = true);

// Of the linear static response to the scene's loads. Throws ConfigError where no solid could be so soft.
Warnings check_response(const Config& config, const Scene& scene, const BuiltScene& built,
                        const StaticResponse& statics);

// Unknowns up to which the response is computed for a warning's sake.
constexpr int kMostUnknownsOfResponse = 30'000;

// Both kinds, of a scene that is built for them: for studies, whose points run elsewhere. None of a scene that cannot
// be built, of which its points tell.
Warnings slips_of(const Config& scene);

}  // namespace orthodyn
