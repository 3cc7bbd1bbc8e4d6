// The options of PETSc that scenes may give: those that choose and tune a method.
//
// Many others write files wherever they are told to (-ksp_view :FILE, every -..._monitor), read some (-options_file),
// or wait for somebody (-petsc_sleep). They are for whoever starts the program: in PETSC_OPTIONS.
#pragma once

#include <string>

namespace orthodyn::petsc {

// Throws ConfigError for what is no list of options, or has one that is not among those.
void require_allowed(const std::string& options);

}  // namespace orthodyn::petsc
