// Reads a scene file and applies the changes of the command line. The scene is not validated or built (see setup.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// The kinds of YAML input files, told apart by a key that no other kind has.
enum class InputFile { scene, comparison, sweep, stability, fit };

// Throws ConfigError for a file of another kind; the message names the command for that kind.
void refuse_other_kinds(const Config& config, InputFile wanted);

struct SceneChanges {
  std::vector<std::string> set = {};  // "path=value", the value in YAML
  // Replaces integrator.type. Keys of the section `integrator` that the new integrator does not have are dropped. `set`
  // is applied afterwards.
  std::optional<std::string> integrator = std::nullopt;
};

// `left_out`: receives the dropped keys of the integrator. Throws ConfigError for an unreadable file, a file that is
// not a scene, and a change that does not apply.
Config read_scene_file(const std::string& file, const SceneChanges& changes,
                       std::vector<std::string>* left_out = nullptr);

// As above, for a scene already read.
Config changed_scene(Config scene, const SceneChanges& changes, std::vector<std::string>* left_out = nullptr);

// "integrator: max_order has no meaning for newmark and is left out"; "" if nothing was dropped.
std::string left_out_sentence(const std::vector<std::string>& left_out, const SceneChanges& changes);

}  // namespace orthodyn
