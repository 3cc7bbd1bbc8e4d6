#include "lib/simulation/run/run_threads.h"

#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

std::optional<int> named_by(const Config& scene) {
  if (!scene.is_map() || !scene.has("threads") || scene.at("threads").is_null()) return std::nullopt;
  return Value<int>::read(scene.at("threads"), {.range = kThreads});
}

}  // namespace

RunThreads::RunThreads(const Config& scene, bool is_shared) : RunThreads(named_by(scene), is_shared) {}

RunThreads::RunThreads(std::optional<int> named, bool is_shared)
    : loops_(named.value_or(is_shared ? 1 : available_threads())), blas_(is_shared ? named.value_or(1) : named) {}

}  // namespace orthodyn
