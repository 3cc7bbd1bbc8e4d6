#include "integrators/arkode/tableau.h"

#include <cmath>

namespace orthodyn::sundials {

namespace {

constexpr double kSame = 1e-14;  // tolerance for equal coefficients, which are rounded to double precision

}  // namespace

bool ends_in_a_stage(const ARKodeButcherTableMem& t) {
  const int last = t.stages - 1;
  if (std::abs(t.c[last] - 1) > kSame) return false;
  for (int j = 0; j <= last; ++j)
    if (std::abs(t.A[last][j] - t.b[j]) > kSame) return false;
  return true;
}

Tableau with_end_stage(const ARKodeButcherTableMem& t) {
  const int s = t.stages;
  Tableau out(ARKodeButcherTable_Alloc(s + 1, SUNTRUE));
  if (!out) throw RunError("ARKODE could not allocate its table", Reason::out_of_memory);
  out->q = t.q;
  out->p = t.p;
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j < s; ++j) out->A[i][j] = t.A[i][j];
    out->A[s][i] = out->b[i] = t.b[i];
    out->c[i] = t.c[i];
    out->d[i] = t.d ? t.d[i] : 0;
  }
  out->c[s] = 1;
  return out;
}

}  // namespace orthodyn::sundials
