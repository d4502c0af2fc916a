# The files that `cmake --install` and `cpack` install, and their folders.
include(GNUInstallDirs)
set(FORAGE_DOC_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/forage)
include(CMakePackageConfigHelpers)
set(FORAGE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Forage)
set(FORAGE_HEADER_DIR ${CMAKE_INSTALL_INCLUDEDIR}/forage)

install(TARGETS forage EXPORT ForageSdk RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY systems DESTINATION ${CMAKE_INSTALL_DATADIR}/forage)
install(DIRECTORY docs DESTINATION ${FORAGE_DOC_DIR} PATTERN Doxyfile.in EXCLUDE)
install(FILES README.md LICENSE DESTINATION ${FORAGE_DOC_DIR})

# Includes of headers are written from the project's root: <forage/plugin.h> for users, "core/..." in the headers.
install(DIRECTORY tools/api/forage/ DESTINATION ${FORAGE_HEADER_DIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY core/base core/types core/model core/engine core/observe core/run DESTINATION ${FORAGE_HEADER_DIR}/core
        FILES_MATCHING PATTERN "*.h" PATTERN philox.h EXCLUDE)

# Plugins need only Eigen. Programs that run systems need the libraries that Forage itself uses.
set(directories INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${FORAGE_HEADER_DIR})
install(TARGETS forage_sdk forage_random EXPORT ForageSdk ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/forage ${directories})
install(TARGETS forage_api forage_base forage_types forage_model forage_connectivity forage_xml forage_engine forage_observe forage_run
                forage_plugin forage_neurons forage_synapses forage_modules forage_bug_world forage_bug_sensing forage_bug_motion
                forage_bug_simulation forage_bug_module forage_bug_interface forage_plot
        EXPORT ForageEmbedding ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/forage ${directories})
install(EXPORT ForageSdk NAMESPACE forage:: DESTINATION ${FORAGE_CMAKE_DIR})
install(EXPORT ForageEmbedding NAMESPACE forage:: DESTINATION ${FORAGE_CMAKE_DIR})
# The file is not put beside bin/, where find_package() would find it before it is installed and can work.
set(package ${PROJECT_BINARY_DIR}/package)
configure_package_config_file(cmake/ForageConfig.cmake.in ${package}/ForageConfig.cmake INSTALL_DESTINATION ${FORAGE_CMAKE_DIR})
write_basic_package_version_file(${package}/ForageConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${package}/ForageConfig.cmake ${package}/ForageConfigVersion.cmake
              cmake/ForagePlugin.cmake cmake/FindForageBullet.cmake cmake/FindForageHDF5.cmake cmake/FindForageOpenCV.cmake
        DESTINATION ${FORAGE_CMAKE_DIR})

# `cpack --config build/release/CPackConfig.cmake` makes the .deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME forage)
set(CPACK_PACKAGE_CONTACT "The authors of Forage <forage@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake, make | ninja-build, libeigen3-dev, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libfmt-dev, libtinyxml2-dev, libbullet-dev, libopencv-core-dev, libopencv-imgproc-dev, libpng-dev, libcairo2-dev, libgif-dev, zlib1g-dev, libhdf5-dev, libzip-dev, pkg-config")
include(CPack)
