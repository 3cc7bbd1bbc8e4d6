// Loops on several threads of this process (oneTBB). Results must not depend on how many there are: what bodies share
// they only read.
#pragma once

#include <functional>

namespace orthodyn {

// As many as the machine gives this process.
int available_threads();

// For all loops from here on; 1 at first. Not while a loop runs. Precondition: n >= 1.
void set_threads(int n);
int threads();

// body(i) for all i in [0, n): on this thread in order where there is one, else in any order at the same time. Returns
// when all are done; throws what one of them threw.
void parallel_for(int n, const std::function<void(int)>& body);

}  // namespace orthodyn
