// The stiffness C from engineering constants, and its stability.
//
// With D = diag(E1, E2, E3) the compliance of normal strains is D^-1/2 Rho D^-1/2, where Rho has a unit diagonal and
// off-diagonal entries -r_ij with r_ij = nu_ij sqrt(E_j/E_i) = nu_ji sqrt(E_i/E_j). By Sylvester's law of inertia C is
// positive definite if and only if E_i > 0, G_ij > 0 and Rho is positive definite. C is computed from Rho, so that
// rounding errors do not grow with the ratio of the moduli. Li & Barbic (2014) eq. (4)-(8).
#pragma once

#include <array>
#include <string>

#include "lib/material/stiffness.h"

namespace orthodyn {

// nu_ij: contraction along j when stretched along i. Moduli in Pa.
struct OrthotropicConstants {
  Vec3 young = Vec3::Ones();
  double nu12 = 0, nu23 = 0, nu13 = 0;  // nu_ji = nu_ij E_j / E_i
  double g12 = 1, g23 = 1, g13 = 1;
};

// The scaled ratios (r12, r23, r31).
Vec3 scaled_ratios(const OrthotropicConstants& c);

// Eigenvalues of Rho in ascending order.
Vec3 rho_eigenvalues(const OrthotropicConstants& c);

// Constants whose Rho has a smaller eigenvalue count as indefinite: for one combination of strains, C would be over 1e9
// times stiffer than the moduli.
inline constexpr double kSmallestRhoEigenvalue = 1e-9;

bool is_stable(const OrthotropicConstants& c);

// The largest common factor s <= 1 of all Poisson's ratios for which Rho has no eigenvalue < margin:
//     s = min(1, (1 - margin) / (1 - lambda_min)), with the smallest eigenvalue lambda_min of the given Rho.
double stabilising_factor(const OrthotropicConstants& c, double margin = 0.05);
OrthotropicConstants shrink_ratios(const OrthotropicConstants& c, double factor);

// Precondition: is_stable(c).
OrthotropicStiffness stiffness(const OrthotropicConstants& c);

// Message with the violated condition, the admissible range of the offending ratio and the nearest stable set in YAML.
// `reversed`: which of the pairs 12, 23, 13 are given as nu_ji. Precondition: !is_stable(c), with positive moduli.
std::string explain_instability(const OrthotropicConstants& c, const std::array<bool, 3>& reversed = {});

// Message about a repaired set: given ratios, factor, ratios used.
std::string explain_shrinking(const OrthotropicConstants& c, const std::array<bool, 3>& reversed = {});

}  // namespace orthodyn
