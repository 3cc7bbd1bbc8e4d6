// The compressible neo-Hookean law (Simo & Pister, Comput. Methods Appl. Mech. Eng. 46, 1984, 201) at a point:
//     Psi(F) = mu/2 (tr(F^T F) - 3) - mu ln J + lambda/2 (ln J)^2,   J = det F,
//     P = mu (F - F^-T) + lambda ln J F^-T.
// The energy is infinite at J = 0, so that a body cannot be turned inside out. At rest, mu and lambda are Lame's
// constants. Functions throw RecoverableError if J <= 0 in a lane, or if an input is not finite.
#pragma once

#include "lib/element/batch.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

// H Q, Q and results P Q as in corotational_law.h.
Mat3T<Batch> neo_hookean_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q);

// R^T P in material axes, with the rotation R of the polar decomposition of F, Pa.
Mat3T<Batch> neo_hookean_turned_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q);

Batch neo_hookean_energy(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q);  // J/m^3

// Adds d(P Q)/d(H Q) to K; or, for `gauss_newton`, its positive semidefinite part mu dF + lambda (F^-T : dF) F^-T.
void add_neo_hookean_moduli(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q,
                            bool gauss_newton, Mat9T<Batch>& K);

// Viscous stress for the damping beta (s): the second Piola-Kirchhoff stress is beta (2 mu dE/dt + lambda tr(dE/dt) I)
// with the rate of Green's strain E, so that a rigid motion has none. `rate`: dF/dt Q (1/s).
Mat3T<Batch> neo_hookean_viscous_stress(const IsotropicStiffness& c, double beta, const Mat3T<Batch>& H,
                                        const Mat3T<Batch>& Q, const Mat3T<Batch>& rate);
// Adds its derivative with respect to `rate`, which is positive semidefinite, to D (Pa s).
void add_neo_hookean_viscosity(const IsotropicStiffness& c, double beta, const Mat3T<Batch>& H, const Mat3T<Batch>& Q,
                               Mat9T<Batch>& D);

// The mean stress between two states (AddedLawAt::mean_stress) after Gonzalez, Comput. Methods Appl. Mech. Eng. 190,
// 2000, 1763: (F0 + F1)/2 times the derivative 2 dPsi/dC at the mean C = F^T F, corrected along C1 - C0.
Mat3T<Batch> mean_neo_hookean_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H0, const Mat3T<Batch>& H1,
                                     const Mat3T<Batch>& Q);

}  // namespace orthodyn
