# The packages that `cpack` makes: forage (the program and its systems), forage-dev (to write plugins and programs), forage-doc and, where
# they can be built, forage-mpi and python3-forage.
# `./tools/package` builds them so that they are the same byte for byte wherever they are built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Forage authors <forage@forage.invalid>")
set(CPACK_PACKAGE_NAME forage)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program dev doc)
set(same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME forage)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"Forage reads the system files of iqr, in which brain models are wired as
System, Process, Group and Connection, and runs them much faster than real
time, with the same result in every run. It contains the robot and the arenas
of the tutorial of Distributed Adaptive Control.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "forage-dev, forage-doc, ffmpeg")
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME forage-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION
"This package contains headers and libraries. With it, `forage build-plugin`
compiles new types of neurons, synapses and modules, and CMake finds the
package Forage, with which programs run systems and robots.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "forage ${same}, g++ | clang, libeigen3-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "cmake, make | ninja-build")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libfmt-dev, libtinyxml2-dev, libbullet-dev, libopencv-core-dev, libopencv-imgproc-dev, libpng-dev, libcairo2-dev, libgif-dev, zlib1g-dev, libhdf5-dev, libmd-dev, libzip-dev, pkg-config")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME forage-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOC_DESCRIPTION
"This package contains the tutorial, how-to pages and references as text and,
in html/, as a site with search and the reference of the interface for
programs.")

if(TARGET forage-mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_NAME forage-mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_MPI_DESCRIPTION
"This package contains the program forage-mpi, with which the ranks of an MPI
job execute the runs of an experiment.")
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "forage ${same}, openmpi-bin")
endif()

if(FORAGE_HAS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-forage)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
"This package contains the Python module forage: systems and robots are run,
read, changed, recorded and drawn from Python and in notebooks, with NumPy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "forage, fonts-dejavu-core")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "forage-dev, forage-doc, python3-pandas, python3-xarray, python3-scipy, python3-cmaes, jupyter-notebook")
endif()

# What every package of Debian has in share/doc, and the manual page.
file(WRITE ${PROJECT_BINARY_DIR}/package/changelog "forage (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * The changes are in CHANGELOG.md, which forage-doc contains.

 -- ${CPACK_PACKAGE_CONTACT}  Mon, 30 Nov 2026 12:00:00 +0000
")
find_program(GZIP gzip REQUIRED)
set(package_files ${PROJECT_BINARY_DIR}/package/forage.1.gz)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/package/forage.1.gz
                   COMMAND ${GZIP} -9nk -f changelog COMMAND ${CMAKE_COMMAND} -E rename changelog.gz changelog.Debian.gz
                   COMMAND forage man > forage.1 COMMAND ${GZIP} -9n -f forage.1
                   DEPENDS forage WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/package VERBATIM)
install(FILES ${PROJECT_BINARY_DIR}/package/forage.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
if(TARGET forage-mpi)
  list(APPEND package_files ${PROJECT_BINARY_DIR}/package/forage-mpi.1.gz)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/package/forage-mpi.1.gz DEPENDS ${PROJECT_SOURCE_DIR}/tools/cluster/forage-mpi.1
                     COMMAND ${GZIP} -9nc ${PROJECT_SOURCE_DIR}/tools/cluster/forage-mpi.1 > forage-mpi.1.gz
                     WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/package VERBATIM)
  install(FILES ${PROJECT_BINARY_DIR}/package/forage-mpi.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT mpi)
endif()
add_custom_target(package_files ALL DEPENDS ${package_files})
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  install(FILES LICENSE RENAME copyright DESTINATION ${folder} COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz DESTINATION ${folder} COMPONENT ${component})
endforeach()
include(CPack)
