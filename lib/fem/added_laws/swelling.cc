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
  std::vector<Vec3> coefficients;

  Constants(const Mat6& C, const std::vector<Swelling>& causes)
      : stiffness(C.topLeftCorner<3, 3>()), shear(C.bottomLeftCorner<3, 3>()) {
    for (const Swelling& cause : causes) coefficients.push_back(cause.coefficients);
  }
};

using Changes = std::vector<std::shared_ptr<const PointValues::At>>;  // parallel to Constants::coefficients

class SwellingAt : public AddedLawAt {
 public:
  SwellingAt(const Constants& constants, bool is_linear, Changes changes, double load_factor)
      : constants_(constants), is_linear_(is_linear), changes_(std::move(changes)), load_factor_(load_factor) {}

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>*) const override {
    const Mat3T<Batch> s = stress_of(strain(at));
    return is_linear_ ? Mat3T<Batch>(-at.Q * s) : swelling_stress(at.H, at.Q, s);
  }

  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>*) const override {
    if (!is_linear_ && kind == TangentKind::exact) add_swelling_moduli(at.H, at.Q, stress_of(strain(at)), K);
  }

  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    if (is_linear_) return stress(at0, nullptr);
    return mean_swelling_stress(at0.H, at1.H, at0.Q, stress_of(strain(at0)));
  }

  Batch energy(const LawPoint& at) const override {
    const Vec3T<Batch> e = strain(at);
    const Mat3T<Batch> s = stress_of(e);
    return energy_of(at, s) + Batch(0.5) * product(e, s);
  }

  // The rate of the energy for the rate of e*.
  Batch power(const LawPoint& at, const Mat3T<Batch>&) const override {
    const Mat3T<Batch> s = stress_of(strain_rate(at));
    return energy_of(at, s) + product(strain(at), s);
  }

  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return -stress_of(strain(at)); }

 private:
  // e* and its rate (1/s), normal strains along the material axes.
  Vec3T<Batch> strain(const LawPoint& at) const {
    return sum([&](std::size_t k) { return changes_[k]->value[at.index]; });
  }
  Vec3T<Batch> strain_rate(const LawPoint& at) const {
    return sum([&](std::size_t k) { return changes_[k]->rate[at.index]; });
  }
  template <class ChangeOf>
  Vec3T<Batch> sum(ChangeOf&& change_of) const {
    Vec3T<Batch> e = Vec3T<Batch>::Zero();
    for (std::size_t k = 0; k < changes_.size(); ++k)
      e += (load_factor_ * change_of(k)) * constants_.coefficients[k].cast<Batch>();
    return e;
  }

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
  Changes changes_;
  Batch load_factor_;
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
    return of_changes([&](const PointValues& change) { return change.at(t); }, load_factor);
  }
  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<SwellingLaw>(constants_, false, causes_);
  }

  bool is_load() const override { return true; }
  std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const override {
    return of_changes([&](const PointValues& change) { return change.at_peak(start, end); }, 1);
  }
  double seconds_at_peak(double start, double end) const override {
    double longest = 0;
    for (const Swelling& cause : causes_) longest = std::max(longest, cause.change->seconds_at_peak(start, end));
    return longest;
  }

  bool scales_with_stiffness() const override { return true; }
  bool has_energy() const override { return true; }
  bool depends_on_time() const override {
    return std::any_of(causes_.begin(), causes_.end(), [](const Swelling& cause) { return !cause.change->constant(); });
  }
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
  template <class AtOf>
  std::shared_ptr<const AddedLawAt> of_changes(AtOf&& at_of, double load_factor) const {
    Changes changes;
    for (const Swelling& cause : causes_) changes.push_back(at_of(*cause.change));
    return std::make_shared<SwellingAt>(constants_, is_linear_, std::move(changes), load_factor);
  }

  Constants constants_;
  bool is_linear_;
  std::vector<Swelling> causes_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_swelling(const Mat6& stiffness, Kinematics kinematics, std::vector<Swelling> causes) {
  const Constants constants(stiffness, causes);
  return std::make_unique<SwellingLaw>(constants, kinematics == Kinematics::linear, std::move(causes));
}

}  // namespace orthodyn
