#include "lib/simulation/run_threads.h"

#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

std::optional<int> named_by(const Config& scene) {
  if (!scene.is_map() || !scene.has("threads") || scene.at("threads").is_null()) return std::nullopt;
  return Value<int>::read(scene.at("threads"), {.range = kThreads});
}

}  // namespace

RunThreads::RunThreads(const Config& scene) : RunThreads(named_by(scene)) {}

RunThreads::RunThreads(std::optional<int> named) : loops_(named.value_or(available_threads())), blas_(named) {}

}  // namespace orthodyn
