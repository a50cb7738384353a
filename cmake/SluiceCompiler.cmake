# Compiler settings that every target of our own takes through one INTERFACE library.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Precompiled headers and ccache get along only when ccache is told that __TIME__ and macro changes do not matter.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} ${CCACHE_PROGRAM})
endif()

add_library(sluice_compiler INTERFACE)
target_compile_options(sluice_compiler INTERFACE
  -Wall -Wextra -Werror -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wunused
  # No contraction into fused multiply-adds by the compiler's own choice: the same scene gives the same bits whatever
  # code path runs, and where we want an fma we write one.
  -ffp-contract=off
  $<$<AND:$<BOOL:${CCACHE_PROGRAM}>,$<CXX_COMPILER_ID:GNU>>:-fpch-preprocess>
)
# Eigen allocates with the alignment of the widest vector the unit was compiled for; a fixed maximum keeps its types
# layout-compatible between units compiled for different instruction sets.
target_compile_definitions(sluice_compiler INTERFACE EIGEN_MAX_ALIGN_BYTES=16)

if(SLUICE_SANITIZE)
  add_compile_options(-fsanitize=${SLUICE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SLUICE_SANITIZE})
  if(SLUICE_SANITIZE MATCHES thread)
    # g++ warns of every fence that the sanitizer does not follow; Asio's are sound without.
    add_compile_options(-Wno-tsan)
  endif()
endif()
