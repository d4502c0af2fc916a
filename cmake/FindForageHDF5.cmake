# HDF5 with its table interface, as the target forage::hdf5.
#
# The static library where there is one: the shared one of Debian brings curl, Kerberos, LDAP and 25 more with it,
# for files in the cloud, and loading those took a third of the time in which `forage --version` answers.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5)
find_library(HDF5_HL_LIBRARY NAMES hdf5_hl hdf5_serial_hl HINTS ${HDF5_LIBRARY_DIRS})
find_library(HDF5_STATIC_LIBRARY NAMES libhdf5_serial.a libhdf5.a HINTS ${HDF5_LIBRARY_DIRS})
find_library(HDF5_STATIC_HL_LIBRARY NAMES libhdf5_serial_hl.a libhdf5_hl.a HINTS ${HDF5_LIBRARY_DIRS})
find_library(SZ_LIBRARY sz)
find_package(ZLIB)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ForageHDF5 REQUIRED_VARS HDF5_HL_LIBRARY)
if(ForageHDF5_FOUND AND NOT TARGET forage::hdf5)
  add_library(forage::hdf5 INTERFACE IMPORTED)
  if(HDF5_STATIC_LIBRARY AND HDF5_STATIC_HL_LIBRARY AND SZ_LIBRARY AND ZLIB_FOUND)
    target_include_directories(forage::hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
    target_link_libraries(forage::hdf5 INTERFACE ${HDF5_STATIC_HL_LIBRARY} ${HDF5_STATIC_LIBRARY} ${SZ_LIBRARY} ZLIB::ZLIB
                                                 ${CMAKE_DL_LIBS} m)
  else()
    target_link_libraries(forage::hdf5 INTERFACE PkgConfig::HDF5 ${HDF5_HL_LIBRARY})
  endif()
endif()
