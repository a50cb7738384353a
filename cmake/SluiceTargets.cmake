# sluice_add_library(<module> SOURCES ... [PUBLIC libs...] [PRIVATE libs...] [PCH headers...])
# makes the library sluice_<module> (alias sluice::<module>) whose public headers stand in include/sluice/<module>.
function(sluice_add_library module)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;PCH" ${ARGN})
  add_library(sluice_${module} STATIC ${ARG_SOURCES})
  add_library(sluice::${module} ALIAS sluice_${module})
  target_include_directories(sluice_${module} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include)
  target_link_libraries(sluice_${module} PUBLIC ${ARG_PUBLIC} PRIVATE sluice_compiler ${ARG_PRIVATE})
  if(ARG_PCH)
    target_precompile_headers(sluice_${module} PRIVATE ${ARG_PCH})
  endif()
endfunction()

# sluice_add_test(<name> LABEL unit|gl|golden|validation|protocol|browser SOURCES ... LINK libs... [TIMEOUT s]
#                 [ENVIRONMENT VAR=value...])
# makes a GoogleTest program whose cases ctest lists one by one.
function(sluice_add_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINK;ENVIRONMENT;PCH" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE sluice_compiler ${ARG_LINK} GTest::gmock GTest::gtest GTest::gtest_main)
  if(ARG_PCH)
    target_precompile_headers(${name} PRIVATE ${ARG_PCH})
  endif()
  gtest_discover_tests(${name}
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

# sluice_add_benchmark(<name> SOURCES ... LINK libs...) makes a Google Benchmark program that `./run bench` runs.
function(sluice_add_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE sluice_compiler ${ARG_LINK} benchmark::benchmark)
endfunction()
