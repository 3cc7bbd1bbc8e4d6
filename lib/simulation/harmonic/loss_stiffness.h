// The loss of a scene's materials as a stiffness: the imaginary part of complex moduli.
#pragma once

#include <vector>

#include "lib/scene/scene.h"

namespace orthodyn {

// Stiffness C'' (Pa) of the loss: C''_ij = C_ij (eta_i + eta_j) / 2 with the loss factors eta of Young's moduli and
// shear moduli along the material axes; eta C if all are equal. To first order in eta this is the complex stiffness
// whose compliance S_ij = S0_ij / sqrt((1 + i eta_i)(1 + i eta_j)) has complex moduli and real sqrt(nu_ij nu_ji); the
// loss of Poisson's ratios is not measured by itself.
// Source: McIntyre & Woodhouse, Acustica 39, 1978, and Acta Metallurgica 36, 1988 (complex moduli of wood). Throws
// ConfigError at the section if C'' has a negative eigenvalue, so that a strain would gain energy, and for unequal
// factors of an isotropic or nearly incompressible material.
Stiffness loss_of(const Stiffness& stiffness, const MaterialLoss& loss);

// The loss matrix H of the scene, about the unknowns q, on the pattern of its model; empty if no material has losses.
std::vector<double> loss_stiffness(const Scene& scene, const FemModel& model, const Vector& q);

// H V about rest by differences of forces with the largest displacement `small` (m), which have fewer rounding errors
// than products with the matrix; zero if no material has losses.
Eigen::MatrixXd loss_products(const Scene& scene, const FemModel& model, const Eigen::MatrixXd& V, double small);

}  // namespace orthodyn
