#include "lib/study/inputs/scene_entry.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "lib/simulation/run/scene_file.h"

namespace orthodyn {

const Spec<SceneEntry>& SceneEntry::spec() {
  static const auto s = Spec<SceneEntry>()
                            .key("file", &SceneEntry::file, "Scene file.", {.required = true})
                            .key("label", &SceneEntry::label, "Name in the report; default the file's name.")
                            .key("set", &SceneEntry::set, "Changes of the scene by path: {mesh.cells: [45, 9, 9]}.");
  return s;
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
    if (line.starts_with("yaml-language-server:")) continue;
    if (line.empty()) break;
    text += (text.empty() ? "" : " ") + line;
  }
  return text;
}

}  // namespace orthodyn
