// A scene in a study's file: a file name, or a section with a label and changes.
#pragma once

#include <string>

#include "lib/study/inputs/assignments.h"
#include "lib/study/inputs/labels.h"

namespace orthodyn {

// `- beam.yaml` is short for `- {file: beam.yaml}`.
struct SceneEntry {
  FilePath file;
  std::string label;  // default the file's stem
  Assignments set;
  SourceLocation origin;
  static const Spec<SceneEntry>& spec();
};

// Text of a scene file. Throws ConfigError if the file is not YAML or not a scene.
std::string read_scene_text(const FilePath& file);

// First paragraph of the comment at the head of a YAML text, as one line.
std::string head_comment(const std::string& yaml);

// Reads a file name or a section into an Entry, which has `file`, `label` and `origin`. The default label is the file's
// stem.
template <class Entry>
Entry read_file_entry(const Config& c) {
  Entry entry;
  if (c.is_map()) entry = Entry::spec().read(c);
  else entry.file = Value<FilePath>::read(c, {}), entry.origin.where = c.where();
  if (entry.label.empty()) entry.label = stem(entry.file.path);
  return entry;
}

template <class Entry>
ValueSchema file_entry_schema(const std::string& title) {
  const ValueSchema section{
      .kind = ValueSchema::Kind::section, .title = title, .keys = [] { return Entry::spec().keys(); }};
  return {.kind = ValueSchema::Kind::either, .items = {Value<FilePath>::schema(), section}};
}

template <>
struct Value<SceneEntry> {
  static ValueSchema schema() { return file_entry_schema<SceneEntry>("SceneEntry"); }
  static SceneEntry read(const Config& c, const Rule&) { return read_file_entry<SceneEntry>(c); }
  static std::string yaml(const SceneEntry&) { return ""; }
};

}  // namespace orthodyn
