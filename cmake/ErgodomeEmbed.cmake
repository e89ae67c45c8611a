# Embeds files into the program.
#   As a script:  cmake -DOUTPUT=page_files.cpp -P ErgodomeEmbed.cmake -- FILE...   writes the source that defines page_files()
#   As a module:  ergodome_embed(<target> FILES <file>...)   has it written and adds it to the target
if(CMAKE_SCRIPT_MODE_FILE)
  set(arrays "")
  set(rows "")
  set(number 0)
  set(is_file FALSE)
  math(EXPR last "${CMAKE_ARGC} - 1")
  foreach(i RANGE ${last})
    set(file "${CMAKE_ARGV${i}}")
    if(is_file)
      file(READ "${file}" hex HEX)
      string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
      get_filename_component(name "${file}" NAME)
      string(APPEND arrays "constexpr char file_${number}[] = {${bytes}'\\0'};\n")
      string(APPEND rows "    {\"${name}\", {file_${number}, sizeof file_${number} - 1}},\n")
      math(EXPR number "${number} + 1")
    elseif(file STREQUAL "--")
      set(is_file TRUE)
    endif()
  endforeach()
  file(WRITE "${OUTPUT}" "#include \"app/remote/web/page_files.h\"\n\nnamespace ergodome {\n\nnamespace {\n\n${arrays}\n"
                         "constexpr PageFile files[] = {\n${rows}};\n\n}  // namespace\n\n"
                         "std::span<const PageFile> page_files() { return files; }\n\n}  // namespace ergodome\n")
  return()
endif()

include_guard(GLOBAL)
set(ERGODOME_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(ergodome_embed target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FILES")
  list(TRANSFORM arg_FILES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  set(output "${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" -P "${ERGODOME_EMBED_SCRIPT}" -- ${arg_FILES}
    DEPENDS ${arg_FILES} "${ERGODOME_EMBED_SCRIPT}"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
