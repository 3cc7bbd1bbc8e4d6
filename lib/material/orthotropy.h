// From engineering constants to C, and the proof that it is positive definite.
//
// With D = diag(E1, E2, E3) the compliance of normal strains is D^-1/2 Rho D^-1/2, where Rho has a
// unit diagonal and -r_ij off it, r_ij = nu_ij sqrt(E_j/E_i) = nu_ji sqrt(E_i/E_j). By Sylvester's
// law of inertia C is positive definite exactly if E_i > 0, G_ij > 0 and Rho is. C is built from
// Rho, never by inverting the compliance: the rounding error does not grow with the ratio of the E.
// Li & Barbic (2014) eq. (4)-(8).
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

// The off-diagonal entries r12, r23, r31 of -Rho.
Vec3 scaled_ratios(const OrthotropicConstants& c);

// Eigenvalues of Rho in ascending order.
Vec3 rho_eigenvalues(const OrthotropicConstants& c);

// Sets whose smallest eigenvalue of Rho is below this are treated as indefinite: C would be more
// than 1e9 times stiffer in one combination of strains than its moduli say.
inline constexpr double kSmallestRhoEigenvalue = 1e-9;

bool is_stable(const OrthotropicConstants& c);

// The largest common factor s <= 1 for all Poisson's ratios that leaves the smallest eigenvalue of
// Rho at or above `margin`: s = min(1, (1 - margin) / (1 - lambda_min)).
double stabilising_factor(const OrthotropicConstants& c, double margin = 0.05);
OrthotropicConstants shrink_ratios(const OrthotropicConstants& c, double factor);

// Precondition: is_stable(c).
OrthotropicStiffness stiffness(const OrthotropicConstants& c);

// What makes c unstable, the admissible range of the offending ratio and the nearest stable set,
// ready to paste. `reversed` says which of the pairs 12, 23, 13 the user knows as nu_ji: the text
// speaks of these. Precondition: !is_stable(c), with positive moduli.
std::string explain_instability(const OrthotropicConstants& c, const std::array<bool, 3>& reversed = {});

// The same for a set that was repaired: what was given, by which factor it was shrunk, what is used.
std::string explain_shrinking(const OrthotropicConstants& c, const std::array<bool, 3>& reversed = {});

}  // namespace orthodyn
