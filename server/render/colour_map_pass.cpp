#include "colour_map_pass.h"

namespace sluice::render {

ViewGeometry attributeView(const FrameContext& frame) { return divided(frame.surfaceView, 2); }

void ColourMapPass::spread(const FrameContext& frame, const std::vector<float>& values) {
  // Particles that are hidden do not reach the surface; of those that may be seen every one counts.
  std::vector<ViewValue> near;
  near.reserve(frame.selection.visible.size() + frame.selection.large.size());
  const auto add = [&](std::uint32_t i) {
    const Eigen::Vector3f p = frame.view.toView(frame.particles.positions[i]);
    if (p.z() > frame.scale.nearDepth) near.push_back({p.x(), p.y(), p.z(), values[i]});
  };
  for (const std::uint32_t i : frame.selection.visible.particles) add(i);
  for (const std::uint32_t i : frame.selection.large) add(i);
  if (!frame.plan.device.software) {
    spreadOnDevice(frame, near);
    return;
  }
  const std::span<const float> surface = frame.targets.read(Resource::Surface);
  raster_.draw(near, frame.scale.radius, surface, frame.surfaceView, attributeView(frame),
               frame.targets.startAnew(Resource::Attribute));
}

void ColourMapPass::spreadOnDevice(const FrameContext& frame, std::span<const ViewValue> particles) {
  if (!onDevice_) onDevice_.emplace();
  frame.targets.clear(Resource::AttributeSums);
  beginTarget(frame, Resource::AttributeSums);
  bindTexture(frame, 0, Resource::Surface);
  onDevice_->sum(particles, frame.scale.radius, frame.surfaceView, attributeView(frame));

  beginTarget(frame, Resource::Attribute);
  bindTexture(frame, 0, Resource::AttributeSums);
  glUseProgram(onDevice_->finish().name());
  drawPicture();
}

void ColourMapPass::draw(const FrameContext& frame, bool whitening, const ColourTable& colours, const ValueRange& range,
                         double strength) {
  const bool layered = frame.plan.layers > 1;
  auto program = programs_.find({whitening, layered});
  if (program == programs_.end()) {
    std::vector<std::string_view> defines;
    if (whitening) defines.emplace_back("WHITENING");
    if (layered) defines.emplace_back("LAYERED");
    program =
        programs_.emplace(std::pair(whitening, layered), shaders().program("picture.vert", "colour_map.frag", defines))
            .first;
  }
  bindTexture(frame, 1, Resource::Attribute);
  colours.bind(2);
  beginOverPicture(frame, program->second);
  setRange(program->second, range, static_cast<float>(strength), attributeView(frame));
  drawPicture();
}

void ColourMapPass::runVelocityMap(const FrameContext& frame) {
  const v1::VelocityMap& map = frame.look.velocity_map();
  spread(frame, velocitiesOf(map, frame.particles));
  const Eigen::Vector3d colour(map.colour().x(), map.colour().y(), map.colour().z());
  white_.useColour(colour.cast<float>(), frame.scene.tone());
  draw(frame, true, white_, {static_cast<float>(map.from()), static_cast<float>(map.to())}, map.strength());
}

void ColourMapPass::runColourMap(const FrameContext& frame) {
  const v1::ColourMap& map = frame.look.colour_map();
  const std::vector<float> values = valuesOf(map.attribute_case(), frame.particles);
  ValueRange range{static_cast<float>(map.least()), static_cast<float>(map.most())};
  if (range.least == range.most) {
    const auto former = ranges_.find(frame.liquid);
    const bool kept = former != ranges_.end() && former->second.first == map.attribute_case();
    range = robustRange(values, map.has_cool_warm(), kept ? &former->second.second : nullptr);
  }
  ranges_[frame.liquid] = {map.attribute_case(), range};
  spread(frame, values);
  palette_.usePalette(map.palette_case(), frame.scene.tone());
  draw(frame, false, palette_, range, map.strength());
}

ValueRange ColourMapPass::range(std::uint8_t liquid) const {
  const auto found = ranges_.find(liquid);
  return found == ranges_.end() ? ValueRange{} : found->second.second;
}

}  // namespace sluice::render
