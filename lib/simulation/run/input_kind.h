// Which of the program's YAML files one is, by a key that no other kind has.
#pragma once

#include <string>

#include "lib/config/config.h"

namespace orthodyn {

enum class InputFile { scene, comparison, sweep, stability };

// Throws ConfigError for a file of another kind, with the command that takes it.
void refuse_other_kinds(const Config& config, InputFile wanted);

}  // namespace orthodyn
