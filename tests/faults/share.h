// How many of the faults are tried: all, or every fifth where a process takes a third of a second to start.
#pragma once

namespace orthodyn {

#ifdef __SANITIZE_ADDRESS__
inline constexpr int kEvery = 5;
#else
inline constexpr int kEvery = 1;
#endif

}  // namespace orthodyn
