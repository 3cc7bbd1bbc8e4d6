#include "lib/config/registry.h"

#include <algorithm>

#include "lib/config/yaml_typos.h"
#include "lib/core/spelling.h"

namespace orthodyn {

std::vector<std::string>& registry_conflicts() {
  static std::vector<std::string> all;
  return all;
}

std::string registered_type(const Config& config, const std::vector<std::string>& names,
                            const std::map<std::string, std::string>& former_names) {
  if (!config.is_map())
    config.fail_expected("a section with the key 'type' (" + join(names) + ")",
                         config.is_scalar() ? missing_space(config.text()) : "");
  if (!config.has("type")) config.fail("key 'type' is missing; one of " + join(names));
  const Config type = config.at("type");
  const std::string name = type.text();
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  if (const auto renamed = former_names.find(name); renamed != former_names.end()) {
    type.warn("'" + name + "' is now called '" + renamed->second + "'");
    config.resolving().fill_text("type", renamed->second);
    return renamed->second;
  }
  type.fail("unknown '" + name + "'" + did_you_mean(name, names, ".") + " Known: " + join(names) + ".");
}

}  // namespace orthodyn
