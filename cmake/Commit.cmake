# Compiles the current commit into the library. Each build updates commit.cc if the commit has changed. The commit is
# "unknown" without git or outside a clone.
if(CMAKE_SCRIPT_MODE_FILE)
  find_program(GIT git)
  set(COMMIT unknown)
  if(GIT AND EXISTS ${SOURCE_DIR}/.git)
    execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --match=
                    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
    if(status EQUAL 0)
      set(COMMIT ${found})
    endif()
  endif()
  file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "lib/core/versions.h"

namespace orthodyn {

std::string orthodyn_commit() { return "@COMMIT@"; }

}  // namespace orthodyn
]])
  return()
endif()

set(ORTHODYN_COMMIT_SOURCE ${PROJECT_BINARY_DIR}/generated/commit.cc)
set(write_commit ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D OUTPUT=${ORTHODYN_COMMIT_SOURCE}
    -P ${CMAKE_CURRENT_LIST_FILE})
execute_process(COMMAND ${write_commit})
add_custom_target(orthodyn_commit COMMAND ${write_commit} BYPRODUCTS ${ORTHODYN_COMMIT_SOURCE} VERBATIM)
target_sources(orthodyn_core PRIVATE ${ORTHODYN_COMMIT_SOURCE})
set_source_files_properties(${ORTHODYN_COMMIT_SOURCE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                            SKIP_PRECOMPILE_HEADERS ON)
add_dependencies(orthodyn_core orthodyn_commit)
