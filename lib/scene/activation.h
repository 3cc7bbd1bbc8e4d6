// The section `activation`: how far the fibres of muscles (lib/material/fibres) contract, from 0 to 1, in space and
// time.
#pragma once

#include "lib/scene/state_change.h"

namespace orthodyn {

struct Activation : StateChange {
  Activation() { quantity = "value"; }
  static const Spec<Activation>& spec();
};

}  // namespace orthodyn
