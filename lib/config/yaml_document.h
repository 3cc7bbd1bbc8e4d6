// A YAML document as it is read: checked for what yaml-cpp would pass over in silence, and joined with
// the files that it includes. Behind Config, which is the door to all this.
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <string>

namespace orthodyn {

// Throws ConfigError, also for folders.
std::string read_yaml_file(const std::string& path);

// One document, without duplicate keys, merge keys and tags. Throws ConfigError; `file` is for messages.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

// By path, the file that what stands there and below was taken from.
using Origins = std::map<std::string, std::string>;

// Joins the files named by `include` into their sections, see Config::from_file. Throws ConfigError.
Origins resolve_includes(YAML::Node root, const std::string& file);

// "file:line:column"
std::string mark_text(const std::string& file, const YAML::Mark& mark);

std::string child_path(const std::string& parent, const std::string& key);

// How often `node` stands below `root`; an alias repeats it, and writing to one place writes to all.
int occurrences(const YAML::Node& root, const YAML::Node& node);

}  // namespace orthodyn
