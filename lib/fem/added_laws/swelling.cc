#include "lib/fem/added_laws/swelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/element/swelling_law.h"

namespace orthodyn {

namespace {

struct Constants {
  Mat3 stiffness;  // C11, C12, ...: normal stresses of normal strains, Pa
  Mat3 shear;      // shear stresses 12, 23, 31 of normal strains, Pa; zero for orthotropic materials

  explicit Constants(const Mat6& C) : stiffness(C.topLeftCorner<3, 3>()), shear(C.bottomLeftCorner<3, 3>()) {}
};

class SwellingAt : public AddedLawAt {
 public:
  SwellingAt(const Constants& constants, bool is_linear, StressFreeStrain free)
      : constants_(constants), is_linear_(is_linear), free_(std::move(free)) {}

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>*) const override {
    const Mat3T<Batch> s = stress_of(free_.strain(at.index));
    return is_linear_ ? Mat3T<Batch>(-at.Q * s) : swelling_stress(at.H, at.Q, s);
  }

  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>*) const override {
    if (!is_linear_ && kind == TangentKind::exact)
      add_swelling_moduli(at.H, at.Q, stress_of(free_.strain(at.index)), K);
  }

  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    if (is_linear_) return stress(at0, nullptr);
    return mean_swelling_stress(at0.H, at1.H, at0.Q, stress_of(free_.strain(at0.index)));
  }

  Batch energy(const LawPoint& at) const override {
    const Vec3T<Batch> e = free_.strain(at.index);
    const Mat3T<Batch> s = stress_of(e);
    return energy_of(at, s) + Batch(0.5) * product(e, s);
  }

  // The rate of the energy for the rate of e*.
  Batch power(const LawPoint& at, const Mat3T<Batch>&) const override {
    const Mat3T<Batch> s = stress_of(free_.rate(at.index));
    return energy_of(at, s) + product(free_.strain(at.index), s);
  }

  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return -stress_of(free_.strain(at.index)); }

 private:
  // C:e* for normal strains e*.
  Mat3T<Batch> stress_of(const Vec3T<Batch>& e) const {
    const Vec3T<Batch> n = constants_.stiffness.cast<Batch>() * e, t = constants_.shear.cast<Batch>() * e;
    Mat3T<Batch> s;
    s << n[0], t[0], t[2], t[0], n[1], t[1], t[2], t[1], n[2];
    return s;
  }
  static Batch product(const Vec3T<Batch>& e, const Mat3T<Batch>& s) {
    return e[0] * s(0, 0) + e[1] * s(1, 1) + e[2] * s(2, 2);
  }
  // -s : e with the strain e of the body.
  Batch energy_of(const LawPoint& at, const Mat3T<Batch>& s) const {
    if (is_linear_) return -contract<Batch>(s, small_strain<Batch>(at.H, at.Q));
    return swelling_energy(at.H, at.Q, s);
  }

  const Constants& constants_;
  bool is_linear_;
  StressFreeStrain free_;
};

class SwellingLaw : public AddedLaw {
 public:
  SwellingLaw(const Constants& constants, bool is_linear, std::vector<Swelling> causes)
      : constants_(constants), is_linear_(is_linear), causes_(std::move(causes)) {}

  std::string name() const override {
    std::string all;
    for (const Swelling& cause : causes_) all += (all.empty() ? "expansion by " : " and ") + cause.cause;
    return all;
  }
  std::string description() const override {
    std::string all;
    for (const Swelling& cause : causes_) {
      const Vec3& a = cause.coefficients;
      all += fmt::format("{}{:.4g}, {:.4g}, {:.4g} per {}", all.empty() ? "" : "; ", a[0], a[1], a[2],
                         cause.cause == "temperature" ? "K" : "%");
    }
    return name() + ": " + all;
  }
  std::size_t bytes() const override {
    std::size_t all = 0;
    for (const Swelling& cause : causes_) all += cause.change->bytes();
    return all;
  }
  std::shared_ptr<const AddedLawAt> at(double t, double load_factor) const override {
    return of(StressFreeStrain::at(causes_, t, load_factor));
  }
  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<SwellingLaw>(constants_, false, causes_);
  }

  bool is_load() const override { return true; }
  std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const override {
    return of(StressFreeStrain::peak(causes_, start, end));
  }
  double seconds_at_peak(double start, double end) const override {
    double longest = 0;
    for (const Swelling& cause : causes_) longest = std::max(longest, cause.change->seconds_at_peak(start, end));
    return longest;
  }

  bool scales_with_stiffness() const override { return true; }
  bool has_energy() const override { return true; }
  bool depends_on_time() const override { return !are_constant(causes_); }
  bool is_dead() const override { return is_linear_; }

  std::vector<double> breakpoints(double start, double end) const override {
    std::vector<double> all;
    for (const Swelling& cause : causes_)
      for (const double t : times_between(cause.change->kinks(), start, end)) all.push_back(t);
    return all;
  }
  StepLimits step_limits(double start, double end) const override {
    StepLimits all;
    for (const Swelling& cause : causes_) all.add(cause.change->step_limits(start, end));
    return all;
  }

 private:
  std::shared_ptr<const AddedLawAt> of(StressFreeStrain free) const {
    return std::make_shared<SwellingAt>(constants_, is_linear_, std::move(free));
  }

  Constants constants_;
  bool is_linear_;
  std::vector<Swelling> causes_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_swelling(const Mat6& stiffness, Kinematics kinematics, std::vector<Swelling> causes) {
  return std::make_unique<SwellingLaw>(Constants(stiffness), kinematics == Kinematics::linear, std::move(causes));
}

}  // namespace orthodyn
