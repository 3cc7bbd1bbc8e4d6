// Failures that ranks have in common.
#pragma once

#include <string>

#include "lib/core/errors.h"
#include "lib/fem/subdomain.h"

namespace orthodyn {

// What throws RecoverableError on some ranks then throws it on all. `subdomain`: null for a model that is whole.
// Collective.
template <class Compute>
void on_all_ranks(const Subdomain* subdomain, Compute&& compute) {
  if (!subdomain) return compute();
  std::string trouble;
  try {
    compute();
  } catch (const RecoverableError& e) {
    trouble = e.what();
  }
  subdomain->agree(trouble);
}

}  // namespace orthodyn
