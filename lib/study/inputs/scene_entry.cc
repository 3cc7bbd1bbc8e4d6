#include "lib/study/inputs/scene_entry.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "lib/simulation/run/input_kind.h"
#include "lib/study/inputs/labels.h"

namespace orthodyn {

const Spec<SceneEntry>& SceneEntry::spec() {
  static const auto s = Spec<SceneEntry>()
                            .key("file", &SceneEntry::file, "A scene.", {.required = true})
                            .key("label", &SceneEntry::label, "Its name in the report; default the file's.")
                            .key("set", &SceneEntry::set, "Changes by path: {mesh.cells: [45, 9, 9]}.");
  return s;
}

ValueSchema Value<SceneEntry>::schema() {
  const ValueSchema section{
      .kind = ValueSchema::Kind::section, .title = "SceneEntry", .keys = [] { return SceneEntry::spec().keys(); }};
  return {.kind = ValueSchema::Kind::either, .items = {Value<FilePath>::schema(), section}};
}

SceneEntry Value<SceneEntry>::read(const Config& c, const Rule&) {
  SceneEntry entry;
  if (c.is_map()) entry = SceneEntry::spec().read(c);
  else entry.file = Value<FilePath>::read(c, {}), entry.origin.where = c.where();
  if (entry.label.empty()) entry.label = stem(entry.file.path);
  return entry;
}

std::string read_scene_text(const FilePath& file) {
  try {
    refuse_other_kinds(Config::from_file(file.path), InputFile::scene);
  } catch (const ConfigError& e) {
    throw ConfigError(file.where, e.what());
  }
  std::ifstream in(file.path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string head_comment(const std::string& yaml) {
  std::istringstream in(yaml);
  std::string text;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    line.erase(0, line.find_first_not_of("# "));
    if (line.starts_with("yaml-language-server:")) continue;  // meant for editors
    if (line.empty()) break;
    text += (text.empty() ? "" : " ") + line;
  }
  return text;
}

}  // namespace orthodyn
