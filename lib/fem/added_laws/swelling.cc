#include "lib/fem/added_laws/swelling.h"

#include <fmt/format.h>

#include <utility>

#include "lib/element/swelling_law.h"

namespace orthodyn {

namespace {

// The constants of one material.
struct Constants {
  Mat3 stress;    // C:a in material axes, Pa per unit of change
  double energy;  // a:C:a, J/m^3 per unit of change squared

  Constants(const Mat6& C, const Vec3& a) {
    Vec6 strain = Vec6::Zero();
    strain.head<3>() = a;
    const Vec6 s = C * strain;
    stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    energy = s.dot(strain);
  }
};

class SwellingAt : public AddedLawAt {
 public:
  SwellingAt(const Constants& constants, bool is_linear, std::shared_ptr<const PointValues::At> change,
             double load_factor)
      : constants_(constants), is_linear_(is_linear), change_(std::move(change)), load_factor_(load_factor) {}

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>*) const override {
    return is_linear_ ? Mat3T<Batch>(-at.Q * stress_at(at)) : swelling_stress(at.H, at.Q, stress_at(at));
  }

  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>*) const override {
    if (!is_linear_ && kind == TangentKind::exact) add_swelling_moduli(at.H, at.Q, stress_at(at), K);
  }

  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    return is_linear_ ? stress(at0, nullptr) : mean_swelling_stress(at0.H, at1.H, at0.Q, stress_at(at0));
  }

  Batch energy(const LawPoint& at) const override {
    const Batch theta = value(at);
    return theta * unit_energy(at) + Batch(0.5) * theta * theta * Batch(constants_.energy);
  }

  Batch power(const LawPoint& at, const Mat3T<Batch>&) const override {
    const Batch theta = value(at), rate = load_factor_ * change_->rate[at.index];
    return rate * (unit_energy(at) + theta * Batch(constants_.energy));
  }

  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return -stress_at(at); }

 private:
  Mat3T<Batch> unit_stress() const { return constants_.stress.cast<Batch>(); }
  Batch value(const LawPoint& at) const { return load_factor_ * change_->value[at.index]; }
  Mat3T<Batch> stress_at(const LawPoint& at) const { return value(at) * unit_stress(); }
  // -C:a : e.
  Batch unit_energy(const LawPoint& at) const {
    if (is_linear_) return -contract<Batch>(unit_stress(), small_strain<Batch>(at.H, at.Q));
    return swelling_energy(at.H, at.Q, unit_stress());
  }

  const Constants& constants_;
  bool is_linear_;
  std::shared_ptr<const PointValues::At> change_;
  Batch load_factor_;
};

class SwellingLaw : public AddedLaw {
 public:
  SwellingLaw(const Constants& constants, bool is_linear, Swelling swelling)
      : constants_(constants), is_linear_(is_linear), swelling_(std::move(swelling)) {}

  std::string name() const override { return "expansion by " + swelling_.cause; }
  std::string description() const override {
    const Vec3& a = swelling_.coefficients;
    return fmt::format("{}: {:.4g}, {:.4g}, {:.4g} per {}", name(), a[0], a[1], a[2],
                       swelling_.cause == "temperature" ? "K" : "%");
  }
  std::size_t bytes() const override { return swelling_.change->bytes(); }
  std::shared_ptr<const AddedLawAt> at(double t, double load_factor) const override {
    return std::make_shared<SwellingAt>(constants_, is_linear_, swelling_.change->at(t), load_factor);
  }
  bool is_load() const override { return true; }
  std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const override {
    return std::make_shared<SwellingAt>(constants_, is_linear_, swelling_.change->at_peak(start, end), 1);
  }
  double seconds_at_peak(double start, double end) const override {
    return swelling_.change->seconds_at_peak(start, end);
  }

  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<SwellingLaw>(constants_, false, swelling_);
  }

  bool scales_with_stiffness() const override { return true; }
  bool has_energy() const override { return true; }
  bool depends_on_time() const override { return !swelling_.change->constant(); }
  bool is_dead() const override { return is_linear_; }

  std::vector<double> breakpoints(double start, double end) const override {
    return times_between(swelling_.change->kinks(), start, end);
  }
  StepLimits step_limits(double start, double end) const override { return swelling_.change->step_limits(start, end); }

 private:
  Constants constants_;
  bool is_linear_;
  Swelling swelling_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_swelling(const Mat6& stiffness, Kinematics kinematics, Swelling swelling) {
  const Constants constants(stiffness, swelling.coefficients);
  return std::make_unique<SwellingLaw>(constants, kinematics == Kinematics::linear, std::move(swelling));
}

}  // namespace orthodyn
