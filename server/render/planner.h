#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sluice/render/frame_plan.h"

namespace sluice::render {

/// Builds a plan from the top down; one file per part of the frame.
class Planner {
 public:
  Planner(const v1::Scene& scene, core::ImageSize size, std::span<const DataTraits> liquids, const ReuseTraits& reuse,
          const DeviceTraits& device);

  FramePlan plan();

 private:
  // plan_scene.cpp
  void planBackground();
  void planSunlight();
  void planCaustics();
  // plan_bodies.cpp
  bool hasBodies() const;
  bool hasGlass() const;
  void planBodyShadow();
  void planBodies();
  void planBodyEdges();
  void planGlassBehind();
  void planGlassBefore();
  // plan_surface.cpp
  void planSurface();
  void planSplats();
  void planMask();
  void planSmoothing();
  void planThickness();
  // plan_back_surface.cpp
  void planBackSurface();
  bool drawsCoarseBack() const;
  std::vector<PassStep>::const_iterator smoothingStep() const;  ///< Of the liquid at hand, if it is smoothed.
  // plan_noise.cpp
  void planNoise();
  // plan_colour_map.cpp
  void planVelocityMap(int layer);
  void planColourMap(int layer);
  void planMap(Pass pass, const std::string& missing, int layer);
  // plan_study.cpp
  void planStudies();
  // plan_legend.cpp
  void planLegend();
  std::size_t coloursToExplain() const;  ///< Entries of a legend.
  // plan_composite.cpp
  void beginPicture();
  void planComposites();
  void planComposite(int layer);
  void leaveOutOptics();
  void planSpray();
  void planToneMap();
  // plan_cube_map.cpp
  void planCubeMap();
  // plan_foam.cpp
  void planFoam();
  bool planFoamDepth();  ///< Whether there is any to show.

  /// For what is not about one liquid.
  void forTheScene() { liquid_ = 0; }
  void forLiquid(std::size_t liquid) { liquid_ = static_cast<std::uint8_t>(liquid); }
  /// Runs `part` once for every liquid of which there is something to draw.
  template <class Part>
  void forEachLiquid(const Part& part) {
    for (std::size_t k = 0; k < liquids_.size(); ++k) {
      forLiquid(k);
      if (traits().splats() > 0) part();
    }
    forTheScene();
  }

  const v1::Look& look() const { return lookOf(scene_, liquid_); }
  const DataTraits& traits() const { return liquids_[liquid_]; }
  core::ImageSize surfaceSize() const { return dividedSize(size_, look().smoothing().divisor()); }
  core::ImageSize thicknessSize() const { return dividedSize(size_, look().thickness().divisor()); }
  std::size_t liquidsWithSplats() const;
  bool anySpray() const;
  std::size_t foamDots() const { return liquids_.empty() ? 0 : liquids_.front().foamDots; }
  /// The scene under the liquid: in the sunlight that the liquid lets through.
  Resource sceneUnderLiquid() const { return hasScene_ ? Resource::Scene : Resource::Background; }

  /// Resources of the liquid at hand, or of the frame.
  BufferId id(Resource resource) const { return {resource, isOfLiquid(resource) ? liquid_ : std::uint8_t{0}}; }
  std::string named(std::string_view what) const;
  void run(Pass pass, const std::vector<Resource>& reads, const std::vector<Resource>& writes) {
    run(pass, std::string(name(pass)), reads, writes);
  }
  void run(Pass pass, std::string name, const std::vector<Resource>& reads, const std::vector<Resource>& writes,
           int sweeps = 1, int layer = 0);
  void leaveOut(Pass pass, std::string reason) { leaveOut(name(pass), std::move(reason)); }
  void leaveOut(std::string_view what, std::string reason);
  /// Once, however often it is asked for.
  void allocate(Resource resource, PixelFormat format, core::ImageSize size);

  const v1::Scene& scene_;
  core::ImageSize size_;
  std::span<const DataTraits> liquids_;
  const ReuseTraits& reuse_;
  FramePlan plan_;
  std::uint8_t liquid_ = 0;
  bool hasScene_ = false;  ///< Resource::Scene is drawn.
};

}  // namespace sluice::render
