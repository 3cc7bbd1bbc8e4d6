// The options of `orthodyn run`.
#pragma once

#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

struct RunArguments : SceneArguments {
  std::optional<std::string> out;
  bool quiet = false, force = false, resume = false, estimate_error = false;
};

}  // namespace orthodyn
