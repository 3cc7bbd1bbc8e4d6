// Differences between SUNDIALS 6 and 7. No other file checks the version.
#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>
#include <sundials/sundials_types.h>
#include <sundials/sundials_version.h>

#include <string>

#if SUNDIALS_VERSION_MAJOR >= 7
#include <sundials/sundials_core.h>
#endif

namespace orthodyn::sundials {

inline std::string library_version() { return SUNDIALS_VERSION; }

inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

// Writes "FUNCTION: MESSAGE" to the std::string at `text`.
inline void keep_message(const char* function, const char* message, void* text) noexcept {
  try {
    *static_cast<std::string*>(text) = std::string(function ? function : "") + ": " + (message ? message : "");
  } catch (...) {  // out of memory: the message is lost, the flag remains
  }
}

// Redirects a library's error messages from the terminal to *text. `set_handler` is the library's setter
// (CVodeSetErrHandlerFn, IDASetErrHandlerFn), used by version 6 only.
#if SUNDIALS_VERSION_MAJOR >= 7
inline void keep_error(int, const char* function, const char*, const char* message, SUNErrCode code, void* text,
                       SUNContext) noexcept {
  keep_message(function, message ? message : SUNGetErrMsg(code), text);
}
#define ORTHODYN_CAPTURE_ERRORS(set_handler, context, memory, text) \
  (SUNContext_ClearErrHandlers(context), SUNContext_PushErrHandler(context, orthodyn::sundials::keep_error, text))
#else
inline void keep_error(int, const char*, const char* function, char* message, void* text) noexcept {
  keep_message(function, message, text);
}
#define ORTHODYN_CAPTURE_ERRORS(set_handler, context, memory, text) \
  set_handler(memory, orthodyn::sundials::keep_error, text)
#endif

}  // namespace orthodyn::sundials
