// A linear oscillator whose force has named parts: spring, damper and, if loaded, load.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tests/contract/models.h"

namespace orthodyn {

class PartedModel : public LinearModel {
 public:
  explicit PartedModel(const Given& given) : LinearModel(given), given_(given) {}

  std::vector<std::string> force_parts() const override {
    std::vector<std::string> names{"spring", "damper"};
    if (given_.load.size()) names.push_back("load");
    return names;
  }

  std::unique_ptr<Model> only(const std::vector<std::string>& parts) const override {
    const auto has = [&](const std::string& name) {
      return std::find(parts.begin(), parts.end(), name) != parts.end();
    };
    return std::make_unique<Part>(*this, has("spring"), has("damper"), has("load"));
  }

 private:
  class Part : public SmallModel {
   public:
    Part(const PartedModel& whole, bool spring, bool damper, bool load)
        : SmallModel(whole.given_.mass),
          spring_(spring ? whole.given_.stiffness : 0 * whole.given_.stiffness),
          damper_((damper ? whole.given_.beta : 0) * whole.given_.stiffness),
          whole_(whole),
          load_(load) {
      traits_ = whole.traits();
    }
    // The load is the force at q = 0, v = 0.
    void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
      f = -spring_ * q - damper_ * v;
      if (!load_) return;
      const Vector zero = Vector::Zero(num_dofs());
      Vector push(num_dofs());
      whole_.force(t, zero, zero, push);
      f += push;
    }
    State initial() const override { return whole_.initial(); }
    double end() const override { return whole_.end(); }

   private:
    Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return spring_; }
    Matrix damping(const Vector&) const override { return damper_; }
    Matrix spring_, damper_;
    const PartedModel& whole_;
    bool load_;
  };

  Given given_;
};

// Damping ratio 1/20.
inline PartedModel parted_oscillator() {
  return PartedModel({.mass = scalar(2),
                      .stiffness = scalar(18),
                      .beta = 0.1 / 3,
                      .start = Vector::Ones(1),
                      .end = 4,
                      .velocity_scale = 3});
}

}  // namespace orthodyn
