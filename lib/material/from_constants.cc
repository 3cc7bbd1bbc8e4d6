#include "lib/material/from_constants.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

class OfStiffness final : public Material {
 public:
  OfStiffness(double density, const Stiffness& C) : C_(C) { density_ = density; }
  Stiffness stiffness() const override { return C_; }

 private:
  Stiffness C_;
};

void need_positive(const char* name, double x) {
  if (!std::isfinite(x) || !(x > 0)) throw ConfigError(fmt::format("{} must be a positive number, found {}", name, x));
}

void need_finite(const char* name, double x) {
  if (!std::isfinite(x)) throw ConfigError(fmt::format("{} must be a finite number, found {}", name, x));
}

}  // namespace

std::shared_ptr<const Material> make_isotropic(double density, double young, double nu) {
  need_positive("the density", density);
  need_positive("Young's modulus", young);
  if (!(nu > -1 && nu < 0.5)) throw ConfigError(fmt::format("Poisson's ratio must be in (-1, 0.5), found {}", nu));
  return std::make_shared<OfStiffness>(density, isotropic_stiffness(young, nu));
}

std::shared_ptr<const Material> make_orthotropic(double density, const OrthotropicConstants& c) {
  need_positive("the density", density);
  need_positive("E1", c.young[0]);
  need_positive("E2", c.young[1]);
  need_positive("E3", c.young[2]);
  need_positive("G12", c.g12);
  need_positive("G23", c.g23);
  need_positive("G13", c.g13);
  need_finite("nu12", c.nu12);
  need_finite("nu23", c.nu23);
  need_finite("nu13", c.nu13);
  if (!is_stable(c)) throw ConfigError(explain_instability(c));
  return std::make_shared<OfStiffness>(density, stiffness(c));
}

}  // namespace orthodyn
