#include "lib/material/viscoelasticity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

constexpr Range kShare{0, 1};

void check_branch(const PronyBranch& branch, const Config& config) {
  const bool by_constant = branch.normal || branch.shear, by_part = branch.deviatoric || branch.bulk;
  const int ways = (branch.share ? 1 : 0) + (by_constant ? 1 : 0) + (by_part ? 1 : 0);
  if (ways != 1)
    config.fail(
        "give one of: `share` for all constants; `normal` and `shear` for the constants along the axes; "
        "`deviatoric` and `bulk` for the two constants of an isotropic material");
}

// The part of C of an isotropic material that resists changes of volume.
Mat6 volumetric_part(const Mat6& C) {
  Mat6 volume = Mat6::Zero();
  volume.topLeftCorner<3, 3>().setConstant(C.topLeftCorner<3, 3>().sum() / 9);
  return volume;
}

}  // namespace

const Spec<PronyBranch>& PronyBranch::spec() {
  using B = PronyBranch;
  static const auto s =
      Spec<B>()
          .key("time", &B::time, "Relaxation time.", {.required = true, .unit = "s", .range = kPositive})
          .key("share", &B::share, "Share of all constants that relaxes with this time.", {.range = kShare})
          .key("normal", &B::normal, "Shares of the stiffness along the axes 1, 2, 3; default zero.", {.range = kShare})
          .key("shear", &B::shear, "Shares of the shear moduli 12, 23, 31; default zero.", {.range = kShare})
          .key("deviatoric", &B::deviatoric, "Share of the shear modulus of an isotropic material; default zero.",
               {.range = kShare})
          .key("bulk", &B::bulk, "Share of the bulk modulus of an isotropic material; default zero.", {.range = kShare})
          .check(check_branch);
  return s;
}

Mat6 PronyBranch::stiffness(const Mat6& C) const {
  if (share) return *share * C;
  if (deviatoric || bulk) {
    const Mat6 volume = volumetric_part(C);
    return deviatoric.value_or(0) * (C - volume) + bulk.value_or(0) * volume;
  }
  Vec6 root;
  root << normal.value_or(Vec3::Zero()), shear.value_or(Vec3::Zero());
  root = root.cwiseSqrt();
  return root.asDiagonal() * C * root.asDiagonal();
}

Mat6 relaxed_stiffness(const Viscoelasticity& branches, const Mat6& C) {
  Mat6 relaxed = C;
  for (const PronyBranch& branch : branches) relaxed -= branch.stiffness(C);
  return relaxed;
}

bool relaxes_in_volume(const Viscoelasticity& branches, const Mat6& C) {
  constexpr double kRoundOff = 1e-12;
  Vec6 volume;
  volume << Vec3::Ones(), Vec3::Zero();
  return std::any_of(branches.begin(), branches.end(), [&](const PronyBranch& branch) {
    return (branch.stiffness(C) * volume).norm() > kRoundOff * C.norm();
  });
}

std::string why_inadmissible(const Viscoelasticity& branches, const Stiffness& stiffness) {
  for (const PronyBranch& branch : branches)
    if ((branch.deviatoric || branch.bulk) && !std::holds_alternative<IsotropicStiffness>(stiffness))
      return "viscoelastic: `deviatoric` and `bulk` are shares of an isotropic material; use `normal` and `shear`";
  const Mat6 C = voigt(stiffness);
  // Relative to the stiffness at once: the eigenvalues of C^-1/2 C_relaxed C^-1/2, which are 1 - shares.
  const Mat6 root = Eigen::LLT<Mat6>(C).matrixL();
  const Mat6 inverse = root.inverse();
  const double smallest =
      symmetric_eigenvalues(Mat6(inverse * relaxed_stiffness(branches, C) * inverse.transpose())).minCoeff();
  if (smallest > 1e-9) return "";
  return fmt::format(
      "viscoelastic: the relaxed stiffness is not positive definite: in one kind of strain {} of the stiffness is left "
      "after all relaxation; lower the shares. Their sum must stay below 1 for each constant, and `normal` shares that "
      "differ between the axes must leave the coupling of the axes (Poisson's ratios) possible",
      smallest > -1e-9 ? "nothing" : fmt::format("{:.4g}", smallest));
}

}  // namespace orthodyn
