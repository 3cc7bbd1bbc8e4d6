// The stress of swelling at a point: a strain e* that changes the stress-free shape turns the corotational energy
// W(S - I) into W(S - I - e*) = W(S - I) - s:(S - I) + W(e*) with s = C:e*. The elastic law has the first part; this
// file has the rest. Its exact gradient is that of corotational_law.h for the constant stress -s:
//     P = -R (s + [c])   with   G c = a(S s).
// Where the elastic law is blended into an isotropic one (blend.h), so is s into its mean m I:
//     Psi = -chi s:(S - I) - (1 - chi) m tr(S - I).
// Batches are computed together; lanes with blended or inverted states one by one.
#pragma once

#include "lib/element/blend.h"
#include "lib/element/lyapunov.h"
#include "lib/element/polar.h"
#include "lib/element/strain.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

// Functions of the stress s (Pa) in material axes, per lane. H, Q and results as in corotational_law.h.
Mat3T<Batch> swelling_stress(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s);
// -s:(S - I), blended, J/m^3.
Batch swelling_energy(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s);
// Adds d(P Q)/d(H Q), zero in blended states, to K (Pa).
void add_swelling_moduli(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s, Mat9T<Batch>& K);
// CorotationalLaw::mean_stress() for this energy. Throws RecoverableError if a state is inverted or flat.
Mat3T<Batch> mean_swelling_stress(const Mat3T<Batch>& H0, const Mat3T<Batch>& H1, const Mat3T<Batch>& Q,
                                  const Mat3T<Batch>& s);

}  // namespace orthodyn
