#include "integrators/split_force.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void refuse_unknown(const std::vector<std::string>& names, const std::vector<std::string>& parts) {
  for (const auto& name : names) {
    if (contains(parts, name)) continue;
    throw ConfigError(fmt::format("explicit: the force has no part '{}'{}; its parts: {}", name,
                                  did_you_mean(name, parts), join(parts)));
  }
}

}  // namespace

SplitForce split_force(const Model& model, const std::vector<std::string>& explicit_names) {
  const auto parts = model.force_parts();
  if (parts.empty()) throw ConfigError("the model's force has no parts to split by; use arkode_dirk or arkode_erk");
  refuse_unknown(explicit_names, parts);
  std::vector<std::string> chosen, others;
  for (const auto& part : parts) (contains(explicit_names, part) ? chosen : others).push_back(part);
  if (chosen.empty())
    throw ConfigError(
        "explicit: names no part of the force, which makes every part implicit: use arkode_dirk, or give "
        "some of " +
        join(parts));
  if (others.empty())
    throw ConfigError("explicit: names every part of the force (" + join(parts) +
                      "): use arkode_erk, or leave the stiff parts out");
  return {model.only(chosen), model.only(others)};
}

}  // namespace orthodyn
