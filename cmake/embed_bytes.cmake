# Run by sluice_embed_bytes: writes the header and source that hold FILE as an array.
file(READ ${FILE} hex HEX)
# 32 bytes a line.
string(REGEX REPLACE "(................................................................)" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")

file(WRITE ${DIRECTORY}/${HEADER} "#pragma once

#include <span>

namespace ${NAMESPACE} {

std::span<const unsigned char> ${FUNCTION}();

}  // namespace ${NAMESPACE}
")
file(WRITE ${SOURCE} "#include \"${HEADER}\"

namespace ${NAMESPACE} {

std::span<const unsigned char> ${FUNCTION}() {
  static constexpr unsigned char kBytes[] = {
${bytes}
  };
  return kBytes;
}

}  // namespace ${NAMESPACE}
")
