#   forage_add_plugin(NAME source.cpp...)
#
# makes the plugin NAME.so in the folder plugins of the build tree.
function(forage_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE forage::sdk)
  # Plugins do not see each other, and a name in a plugin does not collide with a name elsewhere.
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so CXX_EXTENSIONS OFF
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/plugins)
  target_compile_options(${name} PRIVATE $<$<CONFIG:>:-O3>)  # no build type is set
  target_compile_definitions(${name} PRIVATE $<$<CONFIG:>:NDEBUG>)
  # Forage loads no plugin that other users may change.
  add_custom_command(TARGET ${name} POST_BUILD COMMAND chmod go-w $<TARGET_FILE:${name}> $<TARGET_FILE_DIR:${name}> VERBATIM)
endfunction()
