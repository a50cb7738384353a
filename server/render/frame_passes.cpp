#include "frame_passes.h"

namespace sluice::render {

void FramePasses::bindLights(const v1::Scene& scene) {
  const SceneLights lights = makeSceneLights(scene, bodies_);
  lights_.upload(std::as_bytes(std::span(&lights, 1)));
  glBindBufferBase(GL_UNIFORM_BUFFER, 4, lights_.name());
}

void FramePasses::run(Pass pass, const FrameContext& frame) {
  switch (pass) {
    case Pass::BodyShadow:
      return bodyShadow_.run(frame, bodies_);
    case Pass::Background:
      bodyShadow_.bind();
      return background_.run(frame);
    case Pass::Bodies:
      return bodiesPass_.run(frame, bodies_);
    case Pass::BodyEdges:
      return bodiesPass_.runEdges(frame);
    case Pass::ClipThickness:
      return clipThickness_.run(frame);
    case Pass::GlassBehind:
      return glass_.runBehind(frame, bodies_);
    case Pass::GlassBefore:
      return glass_.runBefore(frame, bodies_);
    case Pass::Sunlight:
      return sunlight_.run(frame, *light_);
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
    case Pass::BackSplats:
      return backSplats_.run(frame);
    case Pass::BackSmoothing:
      return smoothing_.runOnBack(frame);
    case Pass::Noise:
      return noise_.run(frame);
    case Pass::CubeMap:
      bodyShadow_.bind();
      return cubeMap_.run(frame, bodies_);
    case Pass::BeginPicture:
      if (isStudy(frame.scene.view())) return study_.begin(frame);
      return copy(frame, sceneOf(frame), Resource::Picture);
    case Pass::Layers:
      return mask_.runLayers(frame);
    case Pass::ExtendScene:
      return copy(frame, Resource::Picture, Resource::Scene);
    case Pass::Composite:
      return composite_.run(frame);
    case Pass::BlendLiquid:
      return blendLiquid_.run(frame);
    case Pass::VelocityMap:
      return colourMap_.runVelocityMap(frame);
    case Pass::ColourMap:
      return colourMap_.runColourMap(frame);
    case Pass::Study:
      return study_.run(frame);
    case Pass::StudyFoam:
      return study_.runFoam(frame);
    case Pass::Spray:
      return spray_.run(frame);
    case Pass::Foam:
      return foam_.run(frame);
    case Pass::BlendFoam:
      return blendFoam_.run(frame);
    case Pass::ToneMap:
      pixels_ = toneMap_.run(frame);
      return;
    case Pass::Legend:
      return legend_.run(frame, colourMap_, study_, pixels_);
  }
}

}  // namespace sluice::render
