# sluice_embed(<target> HEADER <path> NAMESPACE <ns> FILES ...)
# compiles text files into <target>, so that a program needs nothing beside itself. <path> (as in #include) declares
#   std::span<const EmbeddedFile> embeddedFiles();   // {name, text}, sorted by name
# in <ns>; names are file names without directories.
function(sluice_embed target)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "FILES" ${ARGN})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  cmake_path(REPLACE_EXTENSION ARG_HEADER .cpp OUTPUT_VARIABLE source)
  cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${directory})
  list(SORT ARG_FILES)
  set(absolute "")
  foreach(file IN LISTS ARG_FILES)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    list(APPEND absolute ${file})
  endforeach()
  add_custom_command(
    OUTPUT ${source} ${directory}/${ARG_HEADER}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${absolute}" -DHEADER=${ARG_HEADER} -DNAMESPACE=${ARG_NAMESPACE}
            -DDIRECTORY=${directory} -DSOURCE=${source} -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${absolute} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${source} ${directory}/${ARG_HEADER})
  target_include_directories(${target} PRIVATE ${directory})
endfunction()

# sluice_embed_bytes(<target> HEADER <path> NAMESPACE <ns> FUNCTION <name> FILE <file>)
# compiles a file of any kind into <target>. <path> (as in #include) declares
#   std::span<const unsigned char> <name>();
# in <ns>.
function(sluice_embed_bytes target)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE;FUNCTION;FILE" "" ${ARGN})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  cmake_path(REPLACE_EXTENSION ARG_HEADER .cpp OUTPUT_VARIABLE source)
  cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${directory})
  add_custom_command(
    OUTPUT ${source} ${directory}/${ARG_HEADER}
    COMMAND ${CMAKE_COMMAND} -DFILE=${ARG_FILE} -DHEADER=${ARG_HEADER} -DNAMESPACE=${ARG_NAMESPACE}
            -DFUNCTION=${ARG_FUNCTION} -DDIRECTORY=${directory} -DSOURCE=${source}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_bytes.cmake
    DEPENDS ${ARG_FILE} ${PROJECT_SOURCE_DIR}/cmake/embed_bytes.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${source} ${directory}/${ARG_HEADER})
  target_include_directories(${target} PRIVATE ${directory})
endfunction()
