#include <turbojpeg.h>

#include <memory>

#include "readers.h"
#include "sluice/core/input_error.h"
#include "srgb.h"

namespace sluice::imageio {

namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};

}  // namespace

LinearImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::unique_ptr<void, Destroy> decoder(tjInitDecompress());
  if (!decoder) throw core::EnvironmentError("cannot start a JPEG decoder");
  const auto refuse = [&](const std::string& why) -> core::InputError {
    return {name, "", "is no JPEG that can be read: " + why};
  };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &colours) != 0) {
    throw refuse(tjGetErrorStr2(decoder.get()));
  }
  checkSize(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), name);
  if (colours == TJCS_CMYK || colours == TJCS_YCCK) throw refuse("its colours are those of a print, CMYK");
  const std::size_t values = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint8_t> pixels(values);
  // A warning means that data are missing or damaged, and that what is seen of them is made up. A file of very many
  // scans would take minutes.
  constexpr int kStrict = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  if (tjDecompress2(decoder.get(), bytes.data(), bytes.size(), pixels.data(), width, 0, height, TJPF_RGB, kStrict) !=
      0) {
    throw refuse(tjGetErrorStr2(decoder.get()));
  }
  LinearImage image{{width, height}, std::vector<float>(values)};
  toLinear(pixels, image.values);
  return image;
}

}  // namespace sluice::imageio
