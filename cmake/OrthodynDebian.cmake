# `cpack -G DEB` in the build folder: a Debian package of the program, its library, headers and drawing tools. Its
# dependencies are the libraries of the Debian on which it is built. tools/package --deb adds the libraries for newer processors.
set(CPACK_PACKAGE_NAME orthodyn)
set(CPACK_PACKAGE_CONTACT "The orthodyn developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Dynamics of orthotropic solids with error control")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# orthodyn and orthodyn_petsc find the package's own library here.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libopenblas0-pthread, python3, python3-numpy, python3-matplotlib, python3-pil")
include(CPack)
