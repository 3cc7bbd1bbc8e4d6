// A value of the input, or the word `auto` in its place.
#pragma once

#include <optional>
#include <string>

#include "lib/config/values.h"
#include "lib/core/spelling.h"

namespace orthodyn {

template <class V>
struct AutoOr {
  std::optional<V> value;
};

template <class V>
struct Value<AutoOr<V>> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either,
            .items = {Value<V>::schema(), {.kind = ValueSchema::Kind::word, .names = {"auto"}}}};
  }
  static AutoOr<V> read(const Config& c, const Rule& r) {
    if (c.is_scalar() && c.text() == "auto") return {};
    if (const auto hint = c.is_scalar() ? did_you_mean(c.text(), {"auto"}) : ""; !hint.empty())
      c.fail("expected " + type_text(schema()) + ", found " + c.shown() + hint, InputFault::form);
    return {Value<V>::read(c, r)};
  }
  static std::string yaml(const AutoOr<V>& x) { return x.value ? Value<V>::yaml(*x.value) : "auto"; }
};

}  // namespace orthodyn
