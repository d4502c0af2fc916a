# The files that `cmake --install` installs, and their folders. The components are the packages of cmake/ForagePackage.cmake.
include(GNUInstallDirs)
set(FORAGE_DOC_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/forage)
include(CMakePackageConfigHelpers)
set(FORAGE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Forage)
set(FORAGE_HEADER_DIR ${CMAKE_INSTALL_INCLUDEDIR}/forage)

install(TARGETS forage EXPORT ForageSdk RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET forage-studio)
  install(TARGETS forage-studio RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()
if(TARGET forage-mpi)
  install(TARGETS forage-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
install(DIRECTORY systems DESTINATION ${CMAKE_INSTALL_DATADIR}/forage COMPONENT program)
install(DIRECTORY docs DESTINATION ${FORAGE_DOC_DIR} COMPONENT doc PATTERN Doxyfile.in EXCLUDE)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${FORAGE_DOC_DIR} COMPONENT doc)
install(DIRECTORY ${PROJECT_BINARY_DIR}/site/ DESTINATION ${FORAGE_DOC_DIR}/html COMPONENT doc OPTIONAL)  # `./tools/docs` makes it

# The Python package goes where the distribution's interpreter looks for packages, which depends on the prefix.
if(FORAGE_HAS_PYTHON)
  install(CODE "if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
  set(python_dir lib/python3/dist-packages)
else()
  set(python_dir lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/${FORAGE_PYTHON_PACKAGES})
endif()" COMPONENT python)
  install(TARGETS forage_python LIBRARY DESTINATION "\${python_dir}/forage" COMPONENT python)
  install(DIRECTORY tools/python/forage DESTINATION "\${python_dir}" COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

# Includes of headers are written from the project's root: <forage/plugin.h> for users, "core/..." in the headers.
install(DIRECTORY tools/api/forage/ DESTINATION ${FORAGE_HEADER_DIR} COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(CODE "set(sources ${PROJECT_SOURCE_DIR})\nset(folder ${FORAGE_HEADER_DIR})" COMPONENT dev)
install(SCRIPT cmake/InstallPublicHeaders.cmake COMPONENT dev)

# Plugins need only Eigen. Programs that run systems need the libraries that Forage itself uses.
set(directories INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${FORAGE_HEADER_DIR})
install(TARGETS forage_sdk forage_random EXPORT ForageSdk ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/forage COMPONENT dev ${directories})
install(TARGETS forage_api forage_base forage_formula forage_types forage_model forage_equations forage_connectivity forage_xml forage_engine forage_observe forage_run
                forage_plugin forage_neurons forage_synapses forage_modules forage_devices forage_bug_world forage_bug_sensing forage_bug_motion
                forage_bug_simulation forage_bug_module forage_bug_interface forage_plot
        EXPORT ForageEmbedding ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/forage COMPONENT dev ${directories})
install(EXPORT ForageSdk NAMESPACE forage:: DESTINATION ${FORAGE_CMAKE_DIR} COMPONENT dev)
install(EXPORT ForageEmbedding NAMESPACE forage:: DESTINATION ${FORAGE_CMAKE_DIR} COMPONENT dev)
set(package ${PROJECT_BINARY_DIR}/${FORAGE_CMAKE_DIR})
configure_package_config_file(cmake/ForageConfig.cmake.in ${package}/ForageConfig.cmake INSTALL_DESTINATION ${FORAGE_CMAKE_DIR})
write_basic_package_version_file(${package}/ForageConfigVersion.cmake COMPATIBILITY SameMajorVersion)
set(scripts cmake/ForagePlugin.cmake cmake/FindForageBullet.cmake cmake/FindForageHDF5.cmake cmake/FindForageOpenCV.cmake)
install(FILES ${package}/ForageConfig.cmake ${package}/ForageConfigVersion.cmake ${scripts} DESTINATION ${FORAGE_CMAKE_DIR} COMPONENT dev)

# The build tree has the folders of an installation: the program finds its systems and headers in both in the same way, and so
# does find_package(Forage), which looks beside the bin/ that is in PATH.
export(EXPORT ForageSdk NAMESPACE forage:: FILE ${package}/ForageSdk.cmake)
export(EXPORT ForageEmbedding NAMESPACE forage:: FILE ${package}/ForageEmbedding.cmake)
function(forage_link file folder)
  get_filename_component(name ${file} NAME)
  file(MAKE_DIRECTORY ${folder})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${file} ${folder}/${name} SYMBOLIC)
endfunction()
forage_link(systems ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/forage)
forage_link(core ${PROJECT_BINARY_DIR}/${FORAGE_HEADER_DIR})
foreach(header plugin.h forage.h system.h)
  forage_link(tools/api/forage/${header} ${PROJECT_BINARY_DIR}/${FORAGE_HEADER_DIR})
endforeach()
foreach(script ${scripts})
  forage_link(${script} ${package})
endforeach()
set_target_properties(forage_random PROPERTIES ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/forage)
