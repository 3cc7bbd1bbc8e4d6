#include "lib/element/batch.h"

namespace orthodyn {

const char* vector_instructions() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#else
  return "those of any processor of the architecture";
#endif
}

}  // namespace orthodyn
