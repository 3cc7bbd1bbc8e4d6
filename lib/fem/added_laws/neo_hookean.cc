#include "lib/fem/added_laws/neo_hookean.h"

#include "lib/element/neo_hookean.h"

namespace orthodyn {

namespace {

class NeoHookeanAt : public AddedLawAt {
 public:
  explicit NeoHookeanAt(const IsotropicStiffness& c) : c_(c) {}

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>*) const override {
    return neo_hookean_stress(c_, at.H, at.Q);
  }
  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>*) const override {
    add_neo_hookean_moduli(c_, at.H, at.Q, kind == TangentKind::gauss_newton, K);
  }
  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    return mean_neo_hookean_stress(c_, at0.H, at1.H, at0.Q);
  }
  Batch energy(const LawPoint& at) const override { return neo_hookean_energy(c_, at.H, at.Q); }
  Batch power(const LawPoint&, const Mat3T<Batch>&) const override { return Batch(0); }
  // R^T P, symmetric as the law is isotropic.
  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return neo_hookean_turned_stress(c_, at.H, at.Q); }

 private:
  IsotropicStiffness c_;
};

class NeoHookean : public AddedLaw {
 public:
  explicit NeoHookean(const IsotropicStiffness& c) : c_(c), at_(std::make_shared<NeoHookeanAt>(c)) {}

  std::string name() const override { return "neo-Hookean elasticity"; }
  std::string description() const override { return name(); }
  std::size_t bytes() const override { return 0; }
  std::shared_ptr<const AddedLawAt> at(double, double) const override { return at_; }
  std::unique_ptr<AddedLaw> corotational() const override { return std::make_unique<NeoHookean>(c_); }

  bool is_load() const override { return false; }
  std::shared_ptr<const AddedLawAt> at_peak(double, double) const override { return at_; }
  double seconds_at_peak(double start, double end) const override { return end - start; }

  bool has_energy() const override { return true; }
  bool depends_on_time() const override { return false; }
  bool is_dead() const override { return false; }

 private:
  IsotropicStiffness c_;
  std::shared_ptr<const AddedLawAt> at_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_neo_hookean(const IsotropicStiffness& stiffness) {
  return std::make_unique<NeoHookean>(stiffness);
}

}  // namespace orthodyn
