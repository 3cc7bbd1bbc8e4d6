#include "lib/fem/added_laws/fibre_law.h"
#include "lib/fem/added_laws/fibres.h"

namespace orthodyn {

namespace {

class PassiveFibresAt : public FibreLawAt {
 public:
  PassiveFibresAt(std::shared_ptr<const StretchFunction> stress, bool is_linear)
      : FibreLawAt(is_linear), stress_(std::move(stress)) {}

 private:
  Batch tension(std::size_t, const Batch& x, const Batch*) const override {
    return per_lane([&](int l) { return stress_->value(x[l]); });
  }
  Batch slope(std::size_t, const Batch& x, const Batch*) const override {
    return per_lane([&](int l) { return stress_->slope(x[l]); });
  }
  Batch mean_tension(std::size_t, const Batch& x0, const Batch& x1) const override {
    return per_lane([&](int l) { return stress_->mean(x0[l], x1[l]); });
  }
  Batch potential(std::size_t, const Batch& x) const override {
    return per_lane([&](int l) { return stress_->integral(x[l]); });
  }

  std::shared_ptr<const StretchFunction> stress_;
};

class PassiveFibres : public AddedLaw {
 public:
  PassiveFibres(std::string constants, std::shared_ptr<const StretchFunction> stress, bool is_linear)
      : constants_(std::move(constants)),
        stress_(stress),
        at_any_time_(std::make_shared<PassiveFibresAt>(std::move(stress), is_linear)) {}

  std::string name() const override { return "passive fibres"; }
  std::string description() const override { return name() + ": " + constants_; }
  std::size_t bytes() const override { return 0; }
  std::shared_ptr<const AddedLawAt> at(double, double) const override { return at_any_time_; }
  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<PassiveFibres>(constants_, stress_, false);
  }

  bool is_load() const override { return false; }
  std::shared_ptr<const AddedLawAt> at_peak(double, double) const override { return at_any_time_; }
  double seconds_at_peak(double start, double end) const override { return end - start; }

  bool has_energy() const override { return true; }
  bool depends_on_time() const override { return false; }
  bool is_dead() const override { return false; }
  double largest_modulus() const override { return stress_->slope_bound(); }

 private:
  std::string constants_;
  std::shared_ptr<const StretchFunction> stress_;
  std::shared_ptr<const AddedLawAt> at_any_time_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_passive_fibres(const PassiveFibre& fibre, Kinematics kinematics) {
  return std::make_unique<PassiveFibres>(fibre.description(), fibre.stress(), kinematics == Kinematics::linear);
}

}  // namespace orthodyn
