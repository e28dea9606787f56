# Debian's packages of errmap, by `cpack --config BUILD/CPackConfig.cmake`:
# errmap (the program, with completions, manual and data sets),
# liberrmap-dev (headers, static libraries, CMake's package) and
# python3-errmap where the Python package is built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "The errmap authors")
set(ERRMAP_MAINTAINER "The errmap authors <errmap@example.org>" CACHE STRING
  "Whoever answers for Debian's packages: Name <address>")
set(CPACK_PACKAGE_CONTACT ${ERRMAP_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET errmap_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_ERRMAP_STRIP ${CMAKE_STRIP})
if(CMAKE_CROSSCOMPILING)
  # As Debian names machines; the host's is the default.
  string(REPLACE aarch64 arm64 CPACK_DEBIAN_PACKAGE_ARCHITECTURE
    ${CMAKE_SYSTEM_PROCESSOR})
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What Debian wants beside the files of an installation.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
set(CPACK_ERRMAP_SOURCE ${PROJECT_SOURCE_DIR})

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME errmap)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"maps of machine-tool errors and how far they hold
A machine tool errs by micrometres, and more as it warms up. errmap fits maps
of that error from the axis position and the temperatures: polynomials, neural
nets and averages of them. It tells which map still holds on another day, by
how many micrometres and how surely, and writes it as a program for the
control.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME liberrmap-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libeigen3-dev, libboost-dev, libceres-dev, libnlopt-dev, libnlopt-cxx-dev, libopenblas-dev, libfmt-dev, libssl-dev, libtbb-dev, libsqlite3-dev, zlib1g-dev, libminizip-dev, libpugixml-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"maps of machine-tool errors: library for C++20
Headers, static libraries and the CMake package of errmap: least squares and
neural nets, comparisons of models on held-out cycles and days, tests of
residuals, maps as programs for a control.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-errmap)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-numpy, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-sklearn, python3-matplotlib, python3-tqdm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"maps of machine-tool errors: package for Python
Comparisons of maps on data frames, with the numbers of the program errmap to
the last bit; regressors of scikit-learn in the same tables, and maps as
regressors of scikit-learn.")
include(CPack)
