// The Runge-Kutta tables of ARKODE that the key `table` accepts: those of SUNDIALS 6.4.1.
//
// A name ends in the number of stages, the order of the embedding (omitted if there is none) and the order of the
// method. KVAERNO_5_3_4 (diagonally implicit) is excluded: with this release's coefficients its stability function R(z)
// tends to 0.72 for z -> infinity instead of 0.
#pragma once

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <array>
#include <utility>

#include "lib/config/values.h"

namespace orthodyn {

template <>
struct EnumNames<ARKODE_DIRKTableID> {
  static constexpr std::array<std::pair<ARKODE_DIRKTableID, const char*>, 22> list{{
      {ARKODE_SDIRK_2_1_2, "SDIRK_2_1_2"},
      {ARKODE_BILLINGTON_3_3_2, "BILLINGTON_3_3_2"},
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

template <>
struct EnumNames<ARKODE_ERKTableID> {
  static constexpr std::array<std::pair<ARKODE_ERKTableID, const char*>, 15> list{{
      {ARKODE_HEUN_EULER_2_1_2, "HEUN_EULER_2_1_2"},
      {ARKODE_BOGACKI_SHAMPINE_4_2_3, "BOGACKI_SHAMPINE_4_2_3"},
      {ARKODE_ARK324L2SA_ERK_4_2_3, "ARK324L2SA_ERK_4_2_3"},
      {ARKODE_KNOTH_WOLKE_3_3, "KNOTH_WOLKE_3_3"},
      {ARKODE_ZONNEVELD_5_3_4, "ZONNEVELD_5_3_4"},
      {ARKODE_ARK436L2SA_ERK_6_3_4, "ARK436L2SA_ERK_6_3_4"},
      {ARKODE_ARK437L2SA_ERK_7_3_4, "ARK437L2SA_ERK_7_3_4"},
      {ARKODE_SAYFY_ABURUB_6_3_4, "SAYFY_ABURUB_6_3_4"},
      {ARKODE_CASH_KARP_6_4_5, "CASH_KARP_6_4_5"},
      {ARKODE_FEHLBERG_6_4_5, "FEHLBERG_6_4_5"},
      {ARKODE_DORMAND_PRINCE_7_4_5, "DORMAND_PRINCE_7_4_5"},
      {ARKODE_ARK548L2SA_ERK_8_4_5, "ARK548L2SA_ERK_8_4_5"},
      {ARKODE_ARK548L2SAb_ERK_8_4_5, "ARK548L2SAb_ERK_8_4_5"},
      {ARKODE_VERNER_8_5_6, "VERNER_8_5_6"},
      {ARKODE_FEHLBERG_13_7_8, "FEHLBERG_13_7_8"},
  }};
};

// An explicit and an implicit table with the same weights.
struct AdditivePair {
  ARKODE_ERKTableID explicit_part;
  ARKODE_DIRKTableID implicit_part;
};
enum class AdditiveTable { ark324, ark436, ark437, ark548, ark548b };

template <>
struct EnumNames<AdditiveTable> {
  static constexpr std::array<std::pair<AdditiveTable, const char*>, 5> list{{
      {AdditiveTable::ark324, "ARK324L2SA_4_2_3"},
      {AdditiveTable::ark436, "ARK436L2SA_6_3_4"},
      {AdditiveTable::ark437, "ARK437L2SA_7_3_4"},
      {AdditiveTable::ark548, "ARK548L2SA_8_4_5"},
      {AdditiveTable::ark548b, "ARK548L2SAb_8_4_5"},
  }};
};

inline AdditivePair pair_of(AdditiveTable table) {
  switch (table) {
    case AdditiveTable::ark324: return {ARKODE_ARK324L2SA_ERK_4_2_3, ARKODE_ARK324L2SA_DIRK_4_2_3};
    case AdditiveTable::ark436: return {ARKODE_ARK436L2SA_ERK_6_3_4, ARKODE_ARK436L2SA_DIRK_6_3_4};
    case AdditiveTable::ark437: return {ARKODE_ARK437L2SA_ERK_7_3_4, ARKODE_ARK437L2SA_DIRK_7_3_4};
    case AdditiveTable::ark548: return {ARKODE_ARK548L2SA_ERK_8_4_5, ARKODE_ARK548L2SA_DIRK_8_4_5};
    case AdditiveTable::ark548b: break;
  }
  return {ARKODE_ARK548L2SAb_ERK_8_4_5, ARKODE_ARK548L2SAb_DIRK_8_4_5};
}

}  // namespace orthodyn
