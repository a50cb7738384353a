#include "read_back.h"

#include <span>

namespace sluice::render {

FloatPicture readValues(FrameTargets& targets, BufferId id) {
  if (!targets.has(id)) return {};
  const std::span<const float> values = targets.read(id);
  return {targets.size(id), {values.begin(), values.end()}};
}

RadiancePicture readRadiance(FrameTargets& targets) {
  const BufferId id{targets.has({Resource::Picture}) ? Resource::Picture : Resource::Background};
  RadiancePicture picture{targets.size(id), {}};
  picture.values.resize(4 * static_cast<std::size_t>(picture.size.width) *
                        static_cast<std::size_t>(picture.size.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.framebuffer(id));
  glReadPixels(0, 0, picture.size.width, picture.size.height, GL_RGBA, GL_FLOAT, picture.values.data());
  return picture;
}

}  // namespace sluice::render
