// Checks three directions given by the user, and repairs them if allowed.
#pragma once

#include <functional>

#include "lib/config/values.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

enum class AxesRepair { refuse, orthonormalise };

template <>
struct EnumNames<AxesRepair> {
  static constexpr std::array<std::pair<AxesRepair, const char*>, 2> list{
      {{AxesRepair::refuse, "refuse"}, {AxesRepair::orthonormalise, "orthonormalise"}}};
};

inline constexpr const char* kRepairSentence =
    "Treatment of axes that are left-handed or deviate from orthogonality by more than 1e-3: an error, or the nearest "
    "rotation, with a note.";

// Why the columns are not right-handed orthonormal axes to within kAxesTolerance, or "".
std::string defect_of_axes(const Mat3& columns);
inline constexpr double kAxesTolerance = 1e-3;

// Whether the columns are linearly independent, so that they can be repaired.
bool span_space(const Mat3& columns);

// The rotation nearest to the normalised columns in the Frobenius norm (polar decomposition). Axis 3 of a left-handed
// set is reversed first; orthotropy does not depend on its sign.
Mat3 nearest_axes(const Mat3& columns);

// Calls `refuse` with a message if the columns are no axes and may not, or cannot, be repaired.
using Refuse = std::function<void(const std::string& sentence)>;
void check_axes(const Mat3& columns, AxesRepair repair, const Refuse& refuse);

// The changes of nearest_axes() to a set with a defect: "<defect>; repaired: ...", or "".
std::string repair_note(const Mat3& columns);

}  // namespace orthodyn
