# Builds liborthodyn_petsc in the folder of liborthodyn, where lib/linear/petsc.cc loads it on demand.
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(PETSc REQUIRED)
find_package(SUNDIALS REQUIRED COMPONENTS nvecmpiplusx nvecserial)

file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/petsc/*.cc)
add_library(orthodyn_petsc MODULE ${sources})
target_link_libraries(orthodyn_petsc PRIVATE orthodyn SUNDIALS::nvecmpiplusx PETSc::PETSc MPI::MPI_CXX)
orthodyn_compile(orthodyn_petsc petsc)
# The component `library` can only be installed if orthodyn_petsc is built with orthodyn_library.
add_dependencies(orthodyn_library orthodyn_petsc)
target_compile_definitions(orthodyn_linear PRIVATE ORTHODYN_MPI)
