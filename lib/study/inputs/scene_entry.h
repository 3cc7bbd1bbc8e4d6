// A scene in the list of a study's file: the file's name, or a section with a label and changes.
#pragma once

#include <string>

#include "lib/study/inputs/assignments.h"

namespace orthodyn {

// `- beam.yaml` is short for `- {file: beam.yaml}`.
struct SceneEntry {
  FilePath file;
  std::string label;  // default the file's stem
  Assignments set;
  SourceLocation origin;
  static const Spec<SceneEntry>& spec();
};

// The text of a scene's file. Throws ConfigError for what is no YAML, and for a file of another kind.
std::string read_scene_text(const FilePath& file);

// The first paragraph of the first comment of a YAML text, as one line.
std::string head_comment(const std::string& yaml);

template <>
struct Value<SceneEntry> {
  static ValueSchema schema();
  static SceneEntry read(const Config& c, const Rule&);
  static std::string yaml(const SceneEntry&) { return ""; }
};

}  // namespace orthodyn
