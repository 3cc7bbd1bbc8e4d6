// Calls a reader with untrusted text. It may accept the text or throw ConfigError; anything else is a bug.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lib/core/errors.h"

namespace orthodyn {

template <class Reader>
int only_refuses(const std::uint8_t* data, std::size_t size, Reader&& read) {
  try {
    read(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const ConfigError&) {
  }
  return 0;
}

}  // namespace orthodyn
