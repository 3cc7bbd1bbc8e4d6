// Fibres along material axis 1, whose stress is added to that of the material: a passive stress in tension, and an
// active contraction as of muscle. With the stretch lambda = |F a| of the fibre direction a at rest, the nominal stress
// along the fibre (Pa, per area at rest) is
//
//     T = T_passive(lambda) + activation * stress * f_L(lambda) * f_V(dlambda/dt),
//
// with the peak isometric `stress`, the force-length factor f_L and the force-velocity factor f_V of the classic muscle
// model: Hill, Proc. R. Soc. B 126 (1938); Zajac, Crit. Rev. Biomed. Eng. 17 (1989). The key `type` chooses each of
// T_passive, f_L and f_V, which have their own files.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lib/config/registry.h"
#include "lib/material/fibres/stretch_function.h"

namespace orthodyn {

// T_passive (Pa): zero for lambda <= 1, not negative and not decreasing beyond.
class PassiveFibre {
 public:
  virtual ~PassiveFibre() = default;
  virtual std::shared_ptr<const StretchFunction> stress() const = 0;  // throws ConfigError
  virtual std::string description() const = 0;
};

// f_L >= 0.
class ForceLength {
 public:
  virtual ~ForceLength() = default;
  virtual std::shared_ptr<const StretchFunction> factor() const = 0;  // throws ConfigError
};

// A function of the rate of the stretch, 1/s.
class RateFunction {
 public:
  virtual ~RateFunction() = default;
  virtual double value(double rate) const = 0;
  virtual double slope(double rate) const = 0;  // s
};

// f_V >= 0: does not decrease with the rate, which is negative for shortening; 1 at the rate 0.
class ForceVelocity {
 public:
  virtual ~ForceVelocity() = default;
  virtual std::shared_ptr<const RateFunction> factor() const = 0;  // throws ConfigError
};

struct ActiveFibre {
  double stress = 0;  // Pa
  std::shared_ptr<const ForceLength> length;
  std::shared_ptr<const ForceVelocity> velocity;  // null: f_V = 1
  SourceLocation origin;
  static const Spec<ActiveFibre>& spec();
};

struct Fibres {
  std::shared_ptr<const PassiveFibre> passive;  // null: no passive stress
  std::optional<ActiveFibre> active;
  static const Spec<Fibres>& spec();
};

inline constexpr const char* kFibresSentence =
    "Fibres along axis 1, whose stress is added: a passive stress in tension, a contraction by the scene's key "
    "`activation`, or both.";

}  // namespace orthodyn
