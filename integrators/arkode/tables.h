// The diagonally implicit Runge-Kutta tables of ARKODE that `table` may name.
//
// They are those of SUNDIALS 6.4.1 that are L-stable and stiffly accurate (the last stage is the
// step's end, so that its derivative is known there). Left out: SDIRK_2_1_2 and BILLINGTON_3_3_2,
// which are not stiffly accurate, and KVAERNO_5_3_4, whose R(infinity) is 0.72 in this release.
// A name ends in stages, order of the embedding, order.
#pragma once

#include <arkode/arkode_butcher_dirk.h>

#include <array>
#include <utility>

#include "lib/core/values.h"

namespace orthodyn {

template <>
struct Words<ARKODE_DIRKTableID> {
  static constexpr std::array<std::pair<ARKODE_DIRKTableID, const char*>, 20> list{{
      {ARKODE_TRBDF2_3_3_2, "TRBDF2_3_3_2"},
      {ARKODE_KVAERNO_4_2_3, "KVAERNO_4_2_3"},
      {ARKODE_ARK324L2SA_DIRK_4_2_3, "ARK324L2SA_DIRK_4_2_3"},
      {ARKODE_CASH_5_2_4, "CASH_5_2_4"},
      {ARKODE_CASH_5_3_4, "CASH_5_3_4"},
      {ARKODE_SDIRK_5_3_4, "SDIRK_5_3_4"},
      {ARKODE_ARK436L2SA_DIRK_6_3_4, "ARK436L2SA_DIRK_6_3_4"},
      {ARKODE_KVAERNO_7_4_5, "KVAERNO_7_4_5"},
      {ARKODE_ARK548L2SA_DIRK_8_4_5, "ARK548L2SA_DIRK_8_4_5"},
      {ARKODE_ARK437L2SA_DIRK_7_3_4, "ARK437L2SA_DIRK_7_3_4"},
      {ARKODE_ARK548L2SAb_DIRK_8_4_5, "ARK548L2SAb_DIRK_8_4_5"},
      {ARKODE_ESDIRK324L2SA_4_2_3, "ESDIRK324L2SA_4_2_3"},
      {ARKODE_ESDIRK325L2SA_5_2_3, "ESDIRK325L2SA_5_2_3"},
      {ARKODE_ESDIRK32I5L2SA_5_2_3, "ESDIRK32I5L2SA_5_2_3"},
      {ARKODE_ESDIRK436L2SA_6_3_4, "ESDIRK436L2SA_6_3_4"},
      {ARKODE_ESDIRK43I6L2SA_6_3_4, "ESDIRK43I6L2SA_6_3_4"},
      {ARKODE_QESDIRK436L2SA_6_3_4, "QESDIRK436L2SA_6_3_4"},
      {ARKODE_ESDIRK437L2SA_7_3_4, "ESDIRK437L2SA_7_3_4"},
      {ARKODE_ESDIRK547L2SA_7_4_5, "ESDIRK547L2SA_7_4_5"},
      {ARKODE_ESDIRK547L2SA2_7_4_5, "ESDIRK547L2SA2_7_4_5"},
  }};
};

}  // namespace orthodyn
