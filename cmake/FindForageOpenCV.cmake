# OpenCV's core and imgproc as the target forage::opencv. Debian's libopencv-core-dev and libopencv-imgproc-dev bring
# headers and libraries but no CMake package (that is in libopencv-dev, with everything else of OpenCV).
find_path(FORAGE_OPENCV_INCLUDE opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
foreach(_name core imgproc)
  set(_names opencv_${_name})
  if(FORAGE_WHEEL)  # the shared libraries bring LAPACK, GL and 20 more with them
    list(PREPEND _names libopencv_${_name}.a)
  endif()
  string(TOUPPER ${_name} _variable)
  find_library(FORAGE_OPENCV_${_variable} NAMES ${_names})
endforeach()
mark_as_advanced(FORAGE_OPENCV_INCLUDE FORAGE_OPENCV_CORE FORAGE_OPENCV_IMGPROC)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ForageOpenCV DEFAULT_MSG FORAGE_OPENCV_CORE FORAGE_OPENCV_IMGPROC FORAGE_OPENCV_INCLUDE)
if(ForageOpenCV_FOUND AND NOT TARGET forage::opencv)
  add_library(forage::opencv INTERFACE IMPORTED)
  target_include_directories(forage::opencv SYSTEM INTERFACE ${FORAGE_OPENCV_INCLUDE})
  target_link_libraries(forage::opencv INTERFACE ${FORAGE_OPENCV_IMGPROC} ${FORAGE_OPENCV_CORE})
  if(FORAGE_WHEEL)  # what the static library needs; the function is for windows with OpenGL, and never called
    target_link_libraries(forage::opencv INTERFACE tbb z ${CMAKE_DL_LIBS})
    target_link_options(forage::opencv INTERFACE LINKER:--defsym=glXGetProcAddressARB=0)
  endif()
endif()
