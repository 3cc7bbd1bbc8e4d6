#include "lib/fem/added_laws/viscoelastic.h"

#include <fmt/format.h>

#include <utility>

#include "lib/element/lanes.h"
#include "lib/element/swelling_law.h"
#include "lib/element/turned_strain.h"

namespace orthodyn {

namespace {

struct Branch {
  double time;             // s
  AnisotropicStiffness C;  // C_i, Pa
};
using Branches = std::vector<Branch>;

Mat3T<Batch> strain_matrix(const Vec6T<Batch>& e) {
  const Batch half(0.5);
  Mat3T<Batch> m;
  m << e[0], half * e[3], half * e[5], half * e[3], e[1], half * e[4], half * e[5], half * e[4], e[2];
  return m;
}

Mat3T<Batch> strain_of(const LawPoint& at, bool is_linear) {
  return is_linear ? small_strain<Batch>(at.H, at.Q) : turned_strain(at.H, at.Q);
}

class ViscoelasticAt : public InternalLawAt {
 public:
  ViscoelasticAt(const Branches& branches, bool is_linear, StressFreeStrain free, const PointInternals& internals)
      : branches_(branches), is_linear_(is_linear), free_(std::move(free)), internals_(internals) {
    for (const Branch& branch : branches_) shares_.push_back(internals.state.share(branch.time));
  }

  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>*) const override {
    const Mat3T<Batch> s = relaxed_stress(at);
    return is_linear_ ? Mat3T<Batch>(-at.Q * s) : swelling_stress(at.H, at.Q, s);
  }

  // The stress of the strains z, and the change of z with the strain.
  void add_moduli(const LawPoint& at, const Mat3T<Batch>*, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>*) const override {
    AnisotropicStiffness C;
    for (const Branch& branch : branches_) C.c -= internals_.state.tangent_share(branch.time) * branch.C.c;
    if (is_linear_) return add_linear_strain_moduli(at.Q, C, K);
    add_strain_moduli(at.H, at.Q, C, K);
    if (kind == TangentKind::exact) add_swelling_moduli(at.H, at.Q, relaxed_stress(at), K);
  }

  // Not used by methods: models with internal variables have no discrete gradient.
  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override {
    const Mat3T<Batch> s = Batch(0.5) * (relaxed_stress(at0) + relaxed_stress(at1));
    return is_linear_ ? Mat3T<Batch>(-at0.Q * s) : mean_swelling_stress(at0.H, at1.H, at0.Q, s);
  }

  Batch energy(const LawPoint& at) const override {
    const Mat3T<Batch> s = relaxed_stress(at);
    Batch energy = energy_of(at, s);
    for_each_branch(at, [&](const Branch& branch, const Mat3T<Batch>& y) {
      energy += Batch(0.5) * contract<Batch>(branch.C.stress(y), y);
    });
    return energy;
  }

  // The rate of the energy for the rate of e*, with which y changes at a fixed shape and fixed z.
  Batch power(const LawPoint& at, const Mat3T<Batch>&) const override {
    if (free_.is_zero()) return Batch(0);
    const Mat3T<Batch> rate = free_.rate(at.index).asDiagonal();
    Mat3T<Batch> s_rate = Mat3T<Batch>::Zero();
    Batch sum(0);
    for (std::size_t i = 0; i < branches_.size(); ++i) s_rate += Batch(1 - shares_[i]) * branches_[i].C.stress(rate);
    for_each_branch(at, [&](const Branch& branch, const Mat3T<Batch>& y) {
      const auto i = static_cast<std::size_t>(&branch - branches_.data());
      sum += Batch(1 - shares_[i]) * contract<Batch>(branch.C.stress(y), rate);
    });
    return sum + energy_of(at, s_rate);
  }

  Batch dissipation(const LawPoint& at, const Mat3T<Batch>&) const override {
    const Mat3T<Batch> e = strain_of(at, is_linear_);
    Batch sum(0);
    for_each_branch(at, [&](const Branch& branch, const Mat3T<Batch>& y) {
      const Mat3T<Batch> rest = e - y;
      sum += Batch(1 / branch.time) * contract<Batch>(branch.C.stress(rest), rest);
    });
    return sum;
  }

  Mat3T<Batch> turned_stress(const LawPoint& at) const override { return -relaxed_stress(at); }

  Vec6T<Batch> strain(const LawPoint& at) const override {
    Vec6T<Batch> e = total_strain(at);
    if (!free_.is_zero()) e.head<3>() -= free_.strain(at.index);
    return e;
  }
  Vec6T<Batch> total_strain(const LawPoint& at) const override {
    return voigt_strain<Batch>(strain_of(at, is_linear_));
  }
  Vec6T<Batch> strain_change(const LawPoint& at, const Mat3T<Batch>& dH) const override {
    return voigt_strain<Batch>(is_linear_ ? small_strain<Batch>(dH, at.Q) : turned_strain_change(at.H, at.Q, dH));
  }

 private:
  // -s : e.
  Batch energy_of(const LawPoint& at, const Mat3T<Batch>& s) const {
    if (is_linear_) return -contract<Batch>(s, small_strain<Batch>(at.H, at.Q));
    return swelling_energy(at.H, at.Q, s);
  }

  // visit(branch, y) for all branches.
  template <class Visit>
  void for_each_branch(const LawPoint& at, Visit&& visit) const {
    bool is_needed = false;
    for (const double share : shares_) is_needed = is_needed || share != 0;
    const Mat3T<Batch> e = is_needed ? strain_of(at, is_linear_) : Mat3T<Batch>(Mat3T<Batch>::Zero());
    const bool has_free = !free_.is_zero() && internals_.state.kind != InternalState::Kind::change;
    const Vec3T<Batch> free = has_free ? free_.strain(at.index) : Vec3T<Batch>(Vec3T<Batch>::Zero());
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      Mat3T<Batch> y = Batch(shares_[i]) * e + values(at.index, i);
      if (has_free) y.diagonal() += Batch(1 - shares_[i]) * free;
      visit(branches_[i], y);
    }
  }

  // sum_i C_i:y_i, Pa.
  Mat3T<Batch> relaxed_stress(const LawPoint& at) const {
    Mat3T<Batch> s = Mat3T<Batch>::Zero();
    for_each_branch(at, [&](const Branch& branch, const Mat3T<Batch>& y) { s += branch.C.stress(y); });
    return s;
  }

  // InternalState::values of a branch at a point. The lanes after the last element are zero.
  Mat3T<Batch> values(std::size_t index, std::size_t branch) const {
    if (!internals_.state.values) return Mat3T<Batch>::Zero();
    const int points = internals_.points;
    const auto batch = static_cast<int>(index) / points, point = static_cast<int>(index) % points;
    const double* const all = internals_.state.values + internals_.first;
    double lanes[6][Batch::kLanes] = {};
    for (int l = 0; l < Batch::kLanes; ++l) {
      const int k = batch * Batch::kLanes + l;
      if (k >= internals_.elements) break;
      const double* const own =
          all +
          6 * ((static_cast<std::size_t>(k) * static_cast<std::size_t>(points) + static_cast<std::size_t>(point)) *
                   branches_.size() +
               branch);
      for (int i = 0; i < 6; ++i) lanes[i][l] = own[i];
    }
    Vec6T<Batch> z;
    for (int i = 0; i < 6; ++i) z[i] = Batch::load(lanes[i]);
    return strain_matrix(z);
  }

  const Branches& branches_;
  bool is_linear_;
  StressFreeStrain free_;
  PointInternals internals_;
  std::vector<double> shares_;
};

class Viscoelastic : public AddedLaw, public InternalLaw {
 public:
  Viscoelastic(Branches branches, bool is_linear, std::vector<Swelling> causes, std::string shares)
      : branches_(std::move(branches)), is_linear_(is_linear), causes_(std::move(causes)), shares_(std::move(shares)) {}

  std::string name() const override { return "viscoelasticity"; }
  std::string description() const override { return name() + ": " + shares_; }
  std::size_t bytes() const override { return branches_.size() * sizeof(Branch); }
  // At equilibrium.
  std::shared_ptr<const AddedLawAt> at(double t, double) const override { return at(t, PointInternals{}); }
  std::shared_ptr<const InternalLawAt> at(double t, const PointInternals& internals) const override {
    return std::make_shared<ViscoelasticAt>(branches_, is_linear_, StressFreeStrain::at(causes_, t), internals);
  }
  std::unique_ptr<AddedLaw> corotational() const override {
    return std::make_unique<Viscoelastic>(branches_, false, causes_, shares_);
  }

  bool is_load() const override { return false; }
  // After a strain that grows from `start` to `end`.
  std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const override {
    const InternalState history{InternalState::Kind::history, nullptr, end - start};
    return std::make_shared<ViscoelasticAt>(branches_, is_linear_, StressFreeStrain::peak(causes_, start, end),
                                            PointInternals{history});
  }
  double seconds_at_peak(double start, double end) const override { return end - start; }
  bool scales_with_stiffness() const override { return true; }
  bool has_energy() const override { return true; }
  bool dissipates() const override { return true; }
  bool depends_on_time() const override { return !are_constant(causes_); }
  bool is_dead() const override { return false; }
  const InternalLaw* internal() const override { return this; }

  std::vector<double> relaxation_times() const override {
    std::vector<double> times;
    for (const Branch& branch : branches_) times.push_back(branch.time);
    return times;
  }

 private:
  Branches branches_;
  bool is_linear_;
  std::vector<Swelling> causes_;  // also those of the swelling law, with its kinks and step limits
  std::string shares_;            // for description()
};

}  // namespace

std::unique_ptr<AddedLaw> make_viscoelastic(const Mat6& stiffness, Kinematics kinematics,
                                            const Viscoelasticity& branches, std::vector<Swelling> causes) {
  Branches all;
  std::string shares;
  for (const PronyBranch& branch : branches) {
    const Mat6 C = branch.stiffness(stiffness);
    all.push_back({branch.time, {C}});
    shares += fmt::format("{}{:.3g} % of the stiffness with {:.4g} s", shares.empty() ? "" : ", ",
                          100 * C.trace() / stiffness.trace(), branch.time);
  }
  return std::make_unique<Viscoelastic>(std::move(all), kinematics == Kinematics::linear, std::move(causes),
                                        std::move(shares));
}

}  // namespace orthodyn
