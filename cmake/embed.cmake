# Run by sluice_embed: writes the header and source that hold FILES as raw string literals.
set(entries "")
foreach(file IN LISTS FILES)
  file(READ ${file} text)
  cmake_path(GET file FILENAME name)
  string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()

file(WRITE ${DIRECTORY}/${HEADER} "#pragma once

#include <span>
#include <string_view>

namespace ${NAMESPACE} {

struct EmbeddedFile {
  std::string_view name;
  std::string_view text;
};

std::span<const EmbeddedFile> embeddedFiles();

}  // namespace ${NAMESPACE}
")
file(WRITE ${SOURCE} "#include \"${HEADER}\"

#include <array>

namespace ${NAMESPACE} {

std::span<const EmbeddedFile> embeddedFiles() {
  static constexpr auto kFiles = std::to_array<EmbeddedFile>({
${entries}  });
  return kFiles;
}

}  // namespace ${NAMESPACE}
")
