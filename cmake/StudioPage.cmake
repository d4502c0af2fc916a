# Builds the page of the studio with Node, and makes the source file that holds it: run by the build as
#   cmake -DWEB=tools/studio/web -DTUTORIAL=docs/tutorial -DWORK=folder -DNPM=npm -DSTRICT=ON -DOUTPUT=assets.cpp -DDONE=assets.done -P StudioPage.cmake
# With -DSITE=folder instead of OUTPUT and DONE, it makes the page for browsers only, whose session runs in a worker (tools/web), in that folder.
# Without NPM, or when npm fails and STRICT is off, the page only says how to build it. The file DONE is missing when npm failed, so
# that the next build tries again.
set(page "")
set(mode production)
if(SITE)
  set(mode web)
else()
  file(REMOVE ${DONE})
endif()
if(NPM)
  file(REMOVE_RECURSE ${WORK}/web/src ${WORK}/web/tests ${WORK}/web/tutorial)  # files that are no longer there
  file(COPY ${WEB}/ DESTINATION ${WORK}/web PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)
  file(SHA256 ${WEB}/package-lock.json lock)
  set(stamp ${WORK}/web/node_modules/.forage-${lock})
  set(status 0)
  if(NOT EXISTS ${stamp})
    execute_process(COMMAND ${NPM} ci --no-audit --no-fund --loglevel=error WORKING_DIRECTORY ${WORK}/web RESULT_VARIABLE status)
    if(status EQUAL 0)
      file(TOUCH ${stamp})
    endif()
  endif()
  if(status EQUAL 0)
    file(REMOVE_RECURSE ${WORK}/web/dist)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env FORAGE_TUTORIAL=${TUTORIAL} ${NPM} run build --silent -- --mode ${mode} WORKING_DIRECTORY ${WORK}/web RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  endif()
  if(status EQUAL 0)
    set(page ${WORK}/web/dist)
  elseif(STRICT)
    message(FATAL_ERROR "the page of the studio cannot be built:\n${out}")
  else()
    message("The page of the studio cannot be built (npm failed): the studio only says how to build it. The next build tries again.\n${out}")
  endif()
endif()

if(SITE)
  if(NOT page)
    message(FATAL_ERROR "the page cannot be built: npm is missing, or failed")
  endif()
  file(COPY ${page}/ DESTINATION ${SITE})
  return()
endif()

set(folder ${page})
if(NOT page)
  set(folder ${WORK}/no_page)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/no_studio_page.html ${folder}/index.html COPYONLY)
endif()

find_program(GZIP gzip REQUIRED)
file(REMOVE_RECURSE ${WORK}/packed)
file(MAKE_DIRECTORY ${WORK}/packed)
set(count 0)
set(data "")
set(names "")
set(table "")
file(GLOB_RECURSE files RELATIVE ${folder} ${folder}/*)
list(SORT files)
foreach(file ${files})
  set(from ${folder}/${file})
  set(gzip false)
  if(file MATCHES "\\.(html|js|css|svg|json|md|txt)$")
    set(gzip true)
    execute_process(COMMAND ${GZIP} -9 -n -c ${from} OUTPUT_FILE ${WORK}/packed/${count} COMMAND_ERROR_IS_FATAL ANY)
    set(from ${WORK}/packed/${count})
  endif()
  string(APPEND data "    \".global forage_asset_${count}, forage_asset_end_${count}\\n\"\n    \"forage_asset_${count}: .incbin \\\"${from}\\\"\\n\"\n    \"forage_asset_end_${count}: .byte 0\\n\"\n")
  string(APPEND names "extern const unsigned char forage_asset_${count}[], forage_asset_end_${count}[];\n")
  string(APPEND table "    {\"/${file}\", forage_asset_${count}, forage_asset_end_${count}, ${gzip}},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/StudioPage.cmake.
asm(\".section .rodata\\n\"
${data}    \".text\\n\");
extern \"C\" {
${names}}
namespace forage::studio {
struct Asset {
    const char* path;
    const unsigned char *begin, *end;
    bool gzip;
};
extern const Asset assets[];
extern const int asset_count;
const Asset assets[] = {
${table}};
const int asset_count = ${count};
}  // namespace forage::studio
")
if(page OR NOT NPM)
  file(TOUCH ${DONE})
endif()
