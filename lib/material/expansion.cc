#include "lib/material/expansion.h"

namespace orthodyn {

namespace {

// A strain of 1 per unit of change is far above any material.
constexpr Range kCoefficients{-1, 1};

template <class E>
void require_one(const E& expansion, const Config& config) {
  if (!expansion.moisture && !expansion.temperature)
    config.fail("is empty; give the coefficients of moisture, temperature or both");
}

}  // namespace

const Spec<Expansion>& Expansion::spec() {
  static const auto s =
      Spec<Expansion>()
          .key("moisture", &Expansion::moisture, "Strains along the axes 1, 2, 3 per per cent of moisture content.",
               {.range = kCoefficients})
          .key("temperature", &Expansion::temperature, "Strains along the axes 1, 2, 3 per kelvin.",
               {.unit = "1/K", .range = kCoefficients})
          .check(require_one<Expansion>);
  return s;
}

const Spec<UniformExpansion>& UniformExpansion::spec() {
  static const auto s = Spec<UniformExpansion>()
                            .key("moisture", &UniformExpansion::moisture, "Strain per per cent of moisture content.",
                                 {.range = kCoefficients})
                            .key("temperature", &UniformExpansion::temperature, "Strain per kelvin.",
                                 {.unit = "1/K", .range = kCoefficients})
                            .check(require_one<UniformExpansion>);
  return s;
}

Expansion UniformExpansion::everywhere() const {
  const auto all = [](const std::optional<double>& x) {
    return x ? std::optional<Vec3>(Vec3::Constant(*x)) : std::nullopt;
  };
  return {all(moisture), all(temperature)};
}

}  // namespace orthodyn
