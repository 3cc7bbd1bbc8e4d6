// Implements read_vega_material().
#include <fmt/format.h>

#include <cmath>

#include "lib/mesh/io/vega_file.h"

namespace orthodyn {
namespace {

constexpr double kRounding = 1e-6;

double positive(TextTokens& tokens, const char* what) {
  const double x = tokens.real(what);
  if (!(x > 0)) tokens.fail("{} is {}; it must be positive", what, x);
  return x;
}

void read_nine_constants(TextTokens& tokens, MeshMaterial& m) {
  m.nu12 = tokens.real("nu12");
  m.nu23 = tokens.real("nu23");
  m.nu31 = tokens.real("nu31");
  m.g12 = positive(tokens, "G12");
  m.g23 = positive(tokens, "G23");
  m.g31 = positive(tokens, "G31");
}

// One Poisson ratio and a factor for the shear moduli: Li & Barbic (2014).
void read_one_ratio(TextTokens& tokens, bool has_factor, MeshMaterial& m) {
  const double nu = tokens.real("nu");
  if (!(nu > -1 && nu < 0.5)) tokens.fail("nu is {}; it must lie in (-1, 0.5)", nu);
  const double factor = has_factor ? positive(tokens, "the factor of the shear moduli") : 1;
  const Vec3& E = m.young;
  const auto shear = [&](int i, int j) { return factor * std::sqrt(E[i] * E[j]) / (2 * (1 + nu)); };
  m.nu12 = nu * std::sqrt(E[0] / E[1]);
  m.nu23 = nu * std::sqrt(E[1] / E[2]);
  m.nu31 = nu * std::sqrt(E[2] / E[0]);
  m.g12 = shear(0, 1);
  m.g23 = shear(1, 2);
  m.g31 = shear(2, 0);
}

std::string rows(const Mat3& R) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{}({:.9g}, {:.9g}, {:.9g})", i == 0 ? "" : ", ", R(i, 0), R(i, 1), R(i, 2));
  return text;
}

// Reversing an axis does not change an orthotropic material.
void read_axes(TextTokens& tokens, MeshMaterial& m, Warnings& warnings) {
  Mat3 R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = tokens.real("an entry of R");
  const double error = (R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kRounding))
    tokens.fail(
        "the axes R are not orthonormal: rows {}; R^T R differs from 1 by {:.3g}, at most {:.0e} is repaired: give "
        "three orthogonal unit vectors as columns",
        rows(R), error, kRounding);
  if (R.determinant() < 0) {
    R.col(2) = -R.col(2);
    warnings.push_back(
        fmt::format("{}:{}: material {}: left-handed axes; axis 3 was reversed, which is the same material",
                    tokens.path(), tokens.line(), TextTokens::quoted(m.name)));
  }
  m.axes.col(0) = R.col(0).normalized();
  m.axes.col(1) = (R.col(1) - m.axes.col(0).dot(R.col(1)) * m.axes.col(0)).normalized();
  m.axes.col(2) = m.axes.col(0).cross(m.axes.col(1));
  if (error > 1e-14)
    warnings.push_back(fmt::format("{}:{}: material {}: R^T R differs from 1 by {:.3g}; the axes were made orthonormal",
                                   tokens.path(), tokens.line(), TextTokens::quoted(m.name), error));
}

void read_isotropic(TextTokens& tokens, MeshMaterial& m) {
  m.kind = MeshMaterial::Kind::isotropic;
  m.density = positive(tokens, "the density");
  m.young.setConstant(positive(tokens, "E"));
  m.nu12 = m.nu23 = m.nu31 = tokens.real("nu");
  if (!(m.nu12 > -1 && m.nu12 < 0.5)) tokens.fail("nu is {}; it must lie in (-1, 0.5)", m.nu12);
  m.g12 = m.g23 = m.g31 = m.young[0] / (2 * (1 + m.nu12));
}

}  // namespace

MeshMaterial read_vega_material(TextTokens& tokens, const std::string& name, Warnings& warnings) {
  MeshMaterial m{.name = name, .where = fmt::format("{}:{}", tokens.path(), tokens.line())};
  const std::string type(tokens.word("the kind of material"));
  if (type == "ENU") {
    read_isotropic(tokens, m);
    tokens.finish_line();
    return m;
  }
  const std::string prefix = "ORTHOTROPIC";
  if (!type.starts_with(prefix))
    tokens.fail("material {}: kind {} is not supported; supported: ENU and ORTHOTROPIC", TextTokens::quoted(name),
                TextTokens::quoted(type));
  const std::string form = type.size() == prefix.size() ? "_N3G3R9" : type.substr(prefix.size());
  const bool known =
      form == "_N3G3R9" || form == "_N3G3" || form == "_N1G1R9" || form == "_N1G1" || form == "_N1R9" || form == "_N1";
  if (!known)
    tokens.fail("material {}: kind {}; the forms of ORTHOTROPIC are _N3G3R9, _N3G3, _N1G1R9, _N1G1, _N1R9, _N1",
                TextTokens::quoted(name), TextTokens::quoted(type));
  m.kind = MeshMaterial::Kind::orthotropic;
  m.density = positive(tokens, "the density");
  for (double& E : m.young) E = positive(tokens, "a Young's modulus");
  if (form.starts_with("_N3")) {
    read_nine_constants(tokens, m);
  } else {
    read_one_ratio(tokens, form.starts_with("_N1G1"), m);
  }
  if (form.ends_with("R9")) read_axes(tokens, m, warnings);
  tokens.finish_line();
  return m;
}

}  // namespace orthodyn
