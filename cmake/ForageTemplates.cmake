# forage_embed_templates(OUTPUT.cpp FOLDER): the files *.in of a folder as a source file (tools/forage/templates.h).
function(forage_embed_templates output folder)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.in)
  set(entries "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} NAME)
    string(REGEX REPLACE "\\.in$" "" name ${name})
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"__(${text})__\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Made from tools/forage/templates by cmake.
#include "tools/forage/templates.h"

#include <map>

namespace forage::tool {

std::string template_text(const std::string& name) {
    static const std::map<std::string, std::string> texts = {
@entries@    };
    return texts.at(name);
}

}  // namespace forage::tool
]])
endfunction()
