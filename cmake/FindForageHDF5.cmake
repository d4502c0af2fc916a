# HDF5 with its table interface, as the target forage::hdf5.
#
# The static library where there is one: the shared one of Debian brings curl, Kerberos, LDAP and 25 more with it,
# for files in the cloud, and loading those took a third of the time in which `forage --version` answers.
find_package(PkgConfig)
if(PkgConfig_FOUND)
  pkg_check_modules(HDF5 QUIET IMPORTED_TARGET hdf5)
endif()
find_library(HDF5_HL_LIBRARY NAMES hdf5_hl hdf5_serial_hl HINTS ${HDF5_LIBRARY_DIRS})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ForageHDF5 REQUIRED_VARS HDF5_HL_LIBRARY HDF5_FOUND)

# The static library is looked for beside the shared one, so that the headers fit. The other libraries that it needs differ, so it is tried.
find_library(HDF5_STATIC_LIBRARY NAMES libhdf5.a PATHS ${HDF5_LIBRARY_DIRS} NO_DEFAULT_PATH)
find_library(HDF5_STATIC_HL_LIBRARY NAMES libhdf5_hl.a PATHS ${HDF5_LIBRARY_DIRS} NO_DEFAULT_PATH)
find_library(SZ_LIBRARY sz)
mark_as_advanced(HDF5_HL_LIBRARY HDF5_STATIC_LIBRARY HDF5_STATIC_HL_LIBRARY SZ_LIBRARY)
find_package(ZLIB)
find_package(Threads)
if(HDF5_STATIC_LIBRARY AND HDF5_STATIC_HL_LIBRARY AND SZ_LIBRARY AND ZLIB_FOUND)
  set(FORAGE_HDF5_STATIC ${HDF5_STATIC_HL_LIBRARY} ${HDF5_STATIC_LIBRARY} ${SZ_LIBRARY} ZLIB::ZLIB Threads::Threads ${CMAKE_DL_LIBS} m)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${FORAGE_HDF5_STATIC})
  check_cxx_source_compiles("#include <hdf5.h>
    #include <hdf5_hl.h>
    int main() { return H5Fcreate(\"a\", 0, 0, 0) < 0 || H5LTfind_dataset(0, \"a\"); }" FORAGE_HDF5_LINKS_STATICALLY)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
endif()

if(ForageHDF5_FOUND AND NOT TARGET forage::hdf5)
  add_library(forage::hdf5 INTERFACE IMPORTED)
  if(FORAGE_HDF5_LINKS_STATICALLY)
    target_include_directories(forage::hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
    # Debian's static library is not compiled for a module of Python, which takes the shared one.
    set(in_module $<STREQUAL:$<TARGET_PROPERTY:TYPE>,MODULE_LIBRARY>)
    target_link_libraries(forage::hdf5 INTERFACE "$<IF:${in_module},PkgConfig::HDF5;${HDF5_HL_LIBRARY},${FORAGE_HDF5_STATIC}>")
  else()
    target_link_libraries(forage::hdf5 INTERFACE PkgConfig::HDF5 ${HDF5_HL_LIBRARY})
  endif()
endif()
