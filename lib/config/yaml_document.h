// YAML documents for Config: parsing with checks that yaml-cpp lacks, the key `include`, and writing at a path.
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <string>

#include "lib/config/config.h"

namespace orthodyn {

// Reads a file. Throws ConfigError if that fails, or if the path is a folder.
std::string read_yaml_file(const std::string& path);

// Parses one document without duplicate keys, merge keys and tags. Throws ConfigError; `file` is for messages.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

// By path: the file from which a value and everything below it was included.
using Origins = std::map<std::string, std::string>;

// Merges the files named by `include` into their sections, see Config::from_file. Throws ConfigError.
Origins resolve_includes(YAML::Node root, const std::string& file);

// "file:line:column"
std::string mark_text(const std::string& file, const YAML::Mark& mark);

std::string child_path(const std::string& parent, const std::string& key);

// The number of times that `node` occurs below `root`. Aliases repeat a node, and writing to one place changes all.
int occurrences(const YAML::Node& root, const YAML::Node& node);

YAML::Node node_of(const ConfigValue& value);

// Sets flow style ({...}, [...]) for a node and everything in it.
void put_on_one_line(YAML::Node node);

// Writes at a path below `node` of the document `root`, as Config::set() does. Errors are reported with `place`.
void write_at(const YAML::Node& root, YAML::Node node, const std::string& path, const YAML::Node& value,
              const std::string& place);

}  // namespace orthodyn
