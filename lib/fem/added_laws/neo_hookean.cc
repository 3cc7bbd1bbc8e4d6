#include "lib/fem/added_laws/neo_hookean.h"

#include "lib/element/axial.h"
#include "lib/element/neo_hookean.h"

namespace orthodyn {

namespace {

class NeoHookeanAt : public AddedLawAt {
 public:
  NeoHookeanAt(const IsotropicStiffness& c, double beta) : c_(c), beta_(beta) {}

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>* rate) const override {
    const Mat3T<Batch> P = neo_hookean_stress(c_, at.H, at.Q);
    return rate ? Mat3T<Batch>(P + neo_hookean_viscous_stress(c_, beta_, at.H, at.Q, *rate)) : P;
  }
  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>* D) const override {
    add_neo_hookean_moduli(c_, at.H, at.Q, kind == TangentKind::gauss_newton, K);
    if (D) add_neo_hookean_viscosity(c_, beta_, at.H, at.Q, *D);
  }
  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    return mean_neo_hookean_stress(c_, at0.H, at1.H, at0.Q);
  }
  Batch energy(const LawPoint& at) const override { return neo_hookean_energy(c_, at.H, at.Q); }
  Batch power(const LawPoint&, const Mat3T<Batch>&) const override { return Batch(0); }
  Batch dissipation(const LawPoint& at, const Mat3T<Batch>& rate) const override {
    return contract<Batch>(neo_hookean_viscous_stress(c_, beta_, at.H, at.Q, rate), rate);
  }
  // R^T P, symmetric as the law is isotropic.
  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return neo_hookean_turned_stress(c_, at.H, at.Q); }

 private:
  IsotropicStiffness c_;
  double beta_;
};

class NeoHookean : public AddedLaw {
 public:
  NeoHookean(const IsotropicStiffness& c, double beta)
      : c_(c), beta_(beta), at_(std::make_shared<NeoHookeanAt>(c, beta)) {}

  std::string name() const override { return "neo-Hookean elasticity"; }
  std::string description() const override { return name(); }
  std::size_t bytes() const override { return 0; }
  std::shared_ptr<const AddedLawAt> at(double, double) const override { return at_; }
  std::unique_ptr<AddedLaw> corotational() const override { return std::make_unique<NeoHookean>(c_, beta_); }

  bool is_load() const override { return false; }
  std::shared_ptr<const AddedLawAt> at_peak(double, double) const override { return at_; }
  double seconds_at_peak(double start, double end) const override { return end - start; }

  bool has_energy() const override { return true; }
  bool depends_on_rate() const override { return beta_ > 0; }
  bool depends_on_time() const override { return false; }
  bool is_dead() const override { return false; }

 private:
  IsotropicStiffness c_;
  double beta_;
  std::shared_ptr<const AddedLawAt> at_;
};

}  // namespace

std::unique_ptr<AddedLaw> make_neo_hookean(const IsotropicStiffness& stiffness, double beta) {
  return std::make_unique<NeoHookean>(stiffness, beta);
}

}  // namespace orthodyn
