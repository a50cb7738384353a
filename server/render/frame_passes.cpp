#include "frame_passes.h"

namespace sluice::render {

void FramePasses::run(Pass pass, const FrameContext& frame) {
  switch (pass) {
    case Pass::Background:
      return background_.run(frame);
    case Pass::GroundShadow:
      return groundShadow_.run(frame, *shadow_, newShadow_);
    case Pass::SelectSplats:
      return;
    case Pass::Splats:
      return splats_.runPoints(frame);
    case Pass::LargeSplats:
      return splats_.runLarge(frame);
    case Pass::Mask:
      return mask_.run(frame);
    case Pass::Smoothing:
      return smoothing_.run(frame);
    case Pass::Thickness:
      return thickness_.runPoints(frame);
    case Pass::LargeThickness:
      return thickness_.runLarge(frame);
    case Pass::SmoothThickness:
      return smoothThickness_.run(frame);
    case Pass::BeginPicture:
      return copy(frame, sceneOf(frame), Resource::Picture);
    case Pass::ExtendScene:
      return copy(frame, Resource::Picture, Resource::Scene);
    case Pass::Composite:
      return composite_.run(frame);
    case Pass::BlendLiquid:
      return blendLiquid_.run(frame);
    case Pass::Spray:
      return spray_.run(frame);
    case Pass::ToneMap:
      pixels_ = toneMap_.run(frame);
      return;
  }
}

}  // namespace sluice::render
