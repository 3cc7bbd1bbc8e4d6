#include "tests/scene/scenes.h"

namespace orthodyn {

BuiltScene build_text(const std::string& yaml) { return build(read_scene(Config::from_text(yaml, "scene.yaml"))); }

std::string refusal(const std::string& yaml) {
  try {
    build_text(yaml);
  } catch (const ConfigError& e) {
    return e.what();
  }
  ADD_FAILURE() << "accepted:\n" << yaml;
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace orthodyn
