#include "lib/simulation/run/input_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace orthodyn {

namespace {

struct Mark {
  InputFile kind;
  const char *key, *words, *command;
};

constexpr std::array<Mark, 4> kMarks{{{InputFile::scene, "mesh", "a scene", "run"},
                                      {InputFile::comparison, "scenes", "a comparison", "compare"},
                                      {InputFile::sweep, "quantities", "a sweep", "sweep"},
                                      {InputFile::stability, "cases", "a file of hard cases", "stability"}}};

}  // namespace

void refuse_other_kinds(const Config& config, InputFile wanted) {
  if (!config.is_map()) return;
  const auto has = [&](const Mark& mark) { return config.has(mark.key); };
  if (std::any_of(kMarks.begin(), kMarks.end(), [&](const Mark& m) { return m.kind == wanted && has(m); })) return;
  if (const auto other = std::find_if(kMarks.begin(), kMarks.end(), has); other != kMarks.end())
    throw ConfigError(config.file(),
                      fmt::format("this is {}: orthodyn {} {}", other->words, other->command, config.file()));
}

}  // namespace orthodyn
