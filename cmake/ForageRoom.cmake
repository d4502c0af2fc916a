# One CMake target per room of the house (docs/design.md).
#
#   forage_room(NAME SOURCES a.cpp b.cpp PUBLIC lib... PRIVATE lib...)
#
# makes the static library forage_NAME. Headers are included by their path from the project's root,
# so that an #include line says which room it comes from.
add_library(forage_options INTERFACE)
target_compile_features(forage_options INTERFACE cxx_std_20)
# The same bits everywhere: no contraction to fused multiply-add, no fast math. Mathematical functions set
# no errno and raise no signals, as both would keep loops with a root or a choice from being vectorised.
target_compile_options(forage_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(forage_options INTERFACE -Wno-restrict)  # GCC 12 warns of its own std::string (bug 105329)
endif()
# The compiler collects its garbage when its heap has grown by 30 to 100 %, which takes a tenth of the time. With enough memory it need not.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)  # MB
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND memory GREATER 7000)
  target_compile_options(forage_options INTERFACE --param=ggc-min-expand=1000 --param=ggc-min-heapsize=1000000)
endif()
if(FORAGE_WERROR)
  target_compile_options(forage_options INTERFACE -Werror)
endif()

function(forage_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(forage_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(forage_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(forage_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  target_compile_options(forage_${name} PRIVATE $<TARGET_PROPERTY:forage_options,INTERFACE_COMPILE_OPTIONS>)
  target_compile_features(forage_${name} PUBLIC cxx_std_20)
  set_target_properties(forage_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
endfunction()

# forage_apart(a.cpp...): files with a name that another file of the target has, too. The presets of the sanitizers compile the other files
# of a target several at a time.
function(forage_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# forage_cold(TARGET...): targets that work before and after the cycles of a run. They are compiled for a short build, not for speed:
# -Og takes less time than -O1, and also less than -O0, which emits every inline function. The build type of the sanitizers is in
# CMakePresets.json. For browsers, they are made small.
function(forage_cold)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<IF:$<PLATFORM_ID:Emscripten>,-Oz,-Og>> $<$<CONFIG:Sanitized>:-O0>)
  endforeach()
endfunction()
