# The linear solvers `cholmod` and `petsc` spend their time in BLAS. The reference BLAS is 2-10 times slower than
# OpenBLAS. `cholesky` uses no BLAS.
find_library(ORTHODYN_BLAS libblas.so.3)
mark_as_advanced(ORTHODYN_BLAS)
if(ORTHODYN_BLAS)
  file(REAL_PATH ${ORTHODYN_BLAS} _blas)
  if(NOT _blas MATCHES openblas)
    message(WARNING "The BLAS in use is ${_blas}, not OpenBLAS: factorisations by cholmod will be several times slower. "
                    "Debian: apt-get install libopenblas0-pthread")
  endif()
endif()
