#include "lib/material/orthotropy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "lib/core/ratio_distance.h"
#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

// A Poisson's ratio nu as given by the user; its scaled ratio is r = nu * factor.
struct Ratio {
  std::string name, other;  // "nu12", "nu21"
  double nu, factor;
  std::string moduli;  // "E1/E2"; stability needs |nu| < sqrt(E1/E2)
};

using Ratios = std::array<Ratio, 3>;

Ratios ratios(const OrthotropicConstants& c, const std::array<bool, 3>& reversed = {}) {
  const auto ratio = [&](int i, int j, double nu_ij, bool turned) -> Ratio {
    if (turned) {
      std::swap(i, j);
      nu_ij *= c.young[i] / c.young[j];  // nu_ji = nu_ij E_j / E_i, i and j swapped already
    }
    return {fmt::format("nu{}{}", i + 1, j + 1), fmt::format("nu{}{}", j + 1, i + 1), nu_ij,
            std::sqrt(c.young[j] / c.young[i]), fmt::format("E{}/E{}", i + 1, j + 1)};
  };
  return {ratio(0, 1, c.nu12, reversed[0]), ratio(1, 2, c.nu23, reversed[1]), ratio(0, 2, c.nu13, reversed[2])};
}

std::string listed(const Ratios& all, const char* each, double factor = 1) {
  std::vector<std::string> parts;
  for (const Ratio& ratio : all) parts.push_back(fmt::format(fmt::runtime(each), ratio.name, factor * ratio.nu));
  return fmt::format("{}", fmt::join(parts, ", "));
}

double rho_determinant(const Vec3& r) { return 1 - r.squaredNorm() - 2 * r.prod(); }

// The open interval of r[i] in which Rho is positive definite, for given values of the other two (each |r| < 1).
std::pair<double, double> admissible(const Vec3& r, int i) {
  const double a = r[(i + 1) % 3], b = r[(i + 2) % 3];
  const double half = std::sqrt((1 - a * a) * (1 - b * b));
  return {-a * b - half, -a * b + half};
}

int largest_ratio(const Vec3& r) {
  int worst = 0;
  r.cwiseAbs().maxCoeff(&worst);
  return worst;
}

std::string violated_inequality(const Ratios& all, const Vec3& r) {
  const int worst = largest_ratio(r);
  const Ratio& ratio = all[static_cast<std::size_t>(worst)];
  if (std::abs(r[worst]) >= 1)
    return fmt::format("|{}| < sqrt({}) = {:.4g} is violated", ratio.name, ratio.moduli, 1 / ratio.factor);
  return fmt::format("1 - nu12 nu21 - nu23 nu32 - nu31 nu13 - 2 nu12 nu23 nu31 > 0 is violated: it is {:.4g}",
                     rho_determinant(r));
}

std::string allowed_range(const Ratios& all, const Vec3& r) {
  const int worst = largest_ratio(r);
  const Ratio& ratio = all[static_cast<std::size_t>(worst)];
  const bool others_fit = std::abs(r[(worst + 1) % 3]) < 1 && std::abs(r[(worst + 2) % 3]) < 1;
  const auto [low, high] = others_fit ? admissible(r, worst) : std::pair{-1.0, 1.0};
  return fmt::format("For these moduli{} {} must lie in ({:.4g}, {:.4g}).",
                     others_fit ? " and the other two ratios" : "", ratio.name, low / ratio.factor,
                     high / ratio.factor);
}

// Suggests the reverse ratio of the worst pair if that makes the set stable, because books differ in the meaning of
// nu12.
std::string likely_swap(const Ratios& all, Vec3 r) {
  const int worst = largest_ratio(r);
  const Ratio& ratio = all[static_cast<std::size_t>(worst)];
  r[worst] = ratio.nu / ratio.factor;
  if (r.cwiseAbs().maxCoeff() >= 1 || rho_determinant(r) <= 0) return "";
  return fmt::format(" If {0} of your source is the contraction along {2} when stretched along {3}, give it as {1}.",
                     ratio.name, ratio.other, ratio.other[3], ratio.other[2]);
}

// Replaces Young's moduli and keeps the Poisson's ratios that the user gave (nu_ij or nu_ji).
OrthotropicConstants with_young(OrthotropicConstants c, const Vec3& young, const std::array<bool, 3>& reversed) {
  const Vec3 factor = young.cwiseQuotient(c.young);
  if (reversed[0]) c.nu12 *= factor[0] / factor[1];
  if (reversed[1]) c.nu23 *= factor[1] / factor[2];
  if (reversed[2]) c.nu13 *= factor[0] / factor[2];
  c.young = young;
  return c;
}

// Asks about the unit of a modulus that would be near the others, with a stable set, if it were 1000 times larger or
// smaller.
std::string likely_unit_error(const OrthotropicConstants& c, const std::array<bool, 3>& reversed) {
  constexpr double kFar = 30;
  for (int i = 0; i < 3; ++i) {
    const double neighbour = c.young[(i + 1) % 3], other = c.young[(i + 2) % 3];
    for (const double factor : {1e3, 1e-3}) {
      Vec3 meant = c.young;
      meant[i] *= factor;
      const auto fits = [&](double E) {
        return ratio_distance(c.young[i], E) > kFar && ratio_distance(meant[i], E) < kFar;
      };
      if (fits(neighbour) && fits(other) && is_stable(with_young(c, meant, reversed)))
        return fmt::format(
            "Is E{} = {:.4g} Pa in the same unit as the other two, {:.4g} and {:.4g} Pa? With {:.4g} Pa the material "
            "is stable",
            i + 1, c.young[i], std::max(neighbour, other), std::min(neighbour, other), meant[i]);
    }
  }
  return "";
}

// Asks about the order of the moduli if the set is stable with the stiffest direction first, as in tables.
std::string likely_order_error(const OrthotropicConstants& c, const std::array<bool, 3>& reversed) {
  Vec3 meant = c.young;
  std::sort(meant.begin(), meant.end(), std::greater<>());
  if (meant == c.young || !is_stable(with_young(c, meant, reversed))) return "";
  return fmt::format(
      "Are the moduli in the order of the axes 1, 2, 3? With {:.4g}, {:.4g}, {:.4g} Pa the material is stable",
      meant[0], meant[1], meant[2]);
}

// A question about the moduli that precedes the complaint about the ratios, or "".
std::string likely_modulus_error(const OrthotropicConstants& c, const std::array<bool, 3>& reversed) {
  std::string question = likely_unit_error(c, reversed);
  if (question.empty()) question = likely_order_error(c, reversed);
  return question.empty() ? "" : question + ". Otherwise ";
}

// The smallest eigenvalue of C, if C exists, for messages.
std::string smallest_eigenvalue(const OrthotropicConstants& c, const Vec3& r) {
  const double lambda = rho_eigenvalues(c)[0];
  if (std::abs(rho_determinant(r)) < 1e-12)
    return fmt::format("C does not exist (smallest eigenvalue of the unit-diagonal compliance {:.3g})", lambda);
  const Mat6 C = voigt(stiffness(c));
  const double smallest = symmetric_eigenvalues(C)[0];
  return fmt::format("smallest eigenvalue of C {:.3g} Pa, of the unit-diagonal compliance {:.3g}", smallest, lambda);
}

}  // namespace

Vec3 scaled_ratios(const OrthotropicConstants& c) {
  Vec3 r;
  for (int i = 0; i < 3; ++i) {
    const Ratio ratio = ratios(c)[static_cast<std::size_t>(i)];
    r[i] = ratio.nu * ratio.factor;
  }
  return r;
}

// The trigonometric formula is not used, because it loses half the digits if two eigenvalues coincide.
Vec3 rho_eigenvalues(const OrthotropicConstants& c) {
  const Vec3 r = scaled_ratios(c);
  Mat3 rho;
  rho << 1, -r[0], -r[2], -r[0], 1, -r[1], -r[2], -r[1], 1;
  return symmetric_eigenvalues(rho);
}

bool is_stable(const OrthotropicConstants& c) {
  return c.young.minCoeff() > 0 && std::min({c.g12, c.g23, c.g13}) > 0 &&
         rho_eigenvalues(c)[0] >= kSmallestRhoEigenvalue;
}

double stabilising_factor(const OrthotropicConstants& c, double margin) {
  const double lambda = rho_eigenvalues(c)[0];
  return lambda >= margin ? 1.0 : (1 - margin) / (1 - lambda);
}

OrthotropicConstants shrink_ratios(const OrthotropicConstants& c, double factor) {
  OrthotropicConstants out = c;
  out.nu12 *= factor;
  out.nu23 *= factor;
  out.nu13 *= factor;
  return out;
}

OrthotropicStiffness stiffness(const OrthotropicConstants& c) {
  const Vec3 r = scaled_ratios(c);
  const double det = rho_determinant(r);
  const Vec3 root = c.young.cwiseSqrt();
  // Rho^-1 by cofactors, with r = (r12, r23, r31).
  const auto entry = [&](double cofactor, int i, int j) { return cofactor / det * root[i] * root[j]; };
  OrthotropicStiffness s;
  s.c11 = entry(1 - r[1] * r[1], 0, 0);
  s.c22 = entry(1 - r[2] * r[2], 1, 1);
  s.c33 = entry(1 - r[0] * r[0], 2, 2);
  s.c12 = entry(r[0] + r[1] * r[2], 0, 1);
  s.c23 = entry(r[1] + r[2] * r[0], 1, 2);
  s.c31 = entry(r[2] + r[0] * r[1], 2, 0);
  s.g12 = c.g12;
  s.g23 = c.g23;
  s.g31 = c.g13;
  return s;
}

std::string explain_instability(const OrthotropicConstants& c, const std::array<bool, 3>& reversed) {
  const Vec3 r = scaled_ratios(c);
  const Ratios all = ratios(c, reversed);
  const double factor = stabilising_factor(c);
  return fmt::format(
      "{}{} make the stiffness indefinite: {} ({}). {}{} Nearest stable set (all ratios times {:.4g}): {}",
      likely_modulus_error(c, reversed), listed(all, "{}={:.4g}"), violated_inequality(all, r),
      smallest_eigenvalue(c, r), allowed_range(all, r), likely_swap(all, r), factor, listed(all, "{}: {:.6g}", factor));
}

std::string explain_shrinking(const OrthotropicConstants& c, const std::array<bool, 3>& reversed) {
  const Ratios all = ratios(c, reversed);
  const double factor = stabilising_factor(c);
  return fmt::format("{} make the stiffness indefinite ({}); all ratios were multiplied by {:.4g}, used are {}",
                     listed(all, "{}={:.4g}"), smallest_eigenvalue(c, scaled_ratios(c)), factor,
                     listed(all, "{}={:.6g}", factor));
}

}  // namespace orthodyn
