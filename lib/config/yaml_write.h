// Writes into a YAML document at a path. Behind Config, as yaml_document.h is.
#pragma once

#include <string>

#include "lib/config/config.h"
#include "lib/config/yaml_document.h"

namespace orthodyn {

YAML::Node node_of(const ConfigValue& value);

// Lists and sections in braces, with all that is in them.
void put_on_one_line(YAML::Node node);

// At a path below `node` of the document `root`: see Config::set(), whose errors it throws with this place.
void write_at(const YAML::Node& root, YAML::Node node, const std::string& path, const YAML::Node& value,
              const std::string& place);

}  // namespace orthodyn
