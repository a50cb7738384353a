#include "smoothing/smoothing_study.h"

#include <algorithm>
#include <array>
#include <memory>

#include "machine.h"
#include "shapes/density_surface.h"
#include "shapes/shape.h"
#include "sluice/gl/context.h"
#include "sluice/scene/convert.h"
#include "sluice/sources/particle_playback.h"
#include "smoothing/page.h"
#include "smoothing/paper_tables.h"
#include "smoothing/shape_rows.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kShapes = "shapes";
constexpr const char* kParticles = "particles";
constexpr const char* kTables = "tables";

/// The shapes of a quick run: flat, convex, and one with saddles and edges inside.
constexpr std::array<std::string_view, 3> kQuickShapes{"plane", "sphere", "torus"};

bool wants(const Options& options, std::string_view part) { return options.only.empty() || options.only == part; }

/// One file's particles from a camera near enough that a spacing is some pixels wide, as in the shapes' pictures.
Subject subjectOfFile(const std::string& file) {
  const v1::Scene scene = sources::sceneForParticleFile(file);
  Subject subject;
  subject.name = kParticles;
  subject.particles = std::move(*sources::openParticlePlayback(scene)->snapshot());
  subject.camera = scene::toCamera(scene.camera());
  // 40 spacings from top to bottom in the middle of the picture: 6.4 pixels each at 256 pixels, 12.8 at 512.
  constexpr float kSpacingsHigh = 40;
  const Eigen::Vector3f away = (subject.camera.eye - subject.camera.target).normalized();
  const float halfHeight = 0.5F * kSpacingsHigh * static_cast<float>(subject.particles.spacing);
  // tan(22.5°): the camera's field of view is 45°.
  const float distance = halfHeight / 0.41421356F;
  // In the middle stands what is nearest to the eye along the line to the bounds' middle.
  Eigen::Vector3f nearest = subject.camera.target;
  for (const Eigen::Vector3f& p : subject.particles.positions) {
    const Eigen::Vector3f offset = p - subject.camera.target;
    const bool beside = (offset - offset.dot(away) * away).norm() < 2 * static_cast<float>(subject.particles.spacing);
    if (beside && offset.dot(away) > (nearest - subject.camera.target).dot(away)) nearest = p;
  }
  subject.camera.target = nearest;
  subject.camera.eye = nearest + distance * away;
  return subject;
}

}  // namespace

std::vector<std::string> smoothingParts() {
  std::vector<std::string> parts{kShapes, kParticles, kTables};
  for (const std::unique_ptr<Shape>& shape : makeShapes()) parts.emplace_back(shape->name());
  return parts;
}

Report runSmoothingStudy(const Options& options) {
  const std::unique_ptr<gl::Context> context = gl::Context::create();
  render::FluidRenderer renderer(*context);
  const std::string machine = machineName(*context);
  const Sweep sweep = smoothingSweep(options.quick);
  Report report;
  std::vector<Row> rows;
  const auto study = [&](const Subject& subject) {
    options.tell(subject.name);
    std::ranges::move(smoothingRows(renderer, subject, sweep, options, report.notes), std::back_inserter(rows));
  };

  for (const std::unique_ptr<Shape>& shape : makeShapes()) {
    const bool named = options.only == shape->name();
    const bool inQuick = std::ranges::find(kQuickShapes, shape->name()) != kQuickShapes.end();
    if (!named && (!wants(options, kShapes) || (options.quick && !inQuick))) continue;
    study({std::string(shape->name()), fillShape(*shape, options.seed), shape.get(), shapeCamera()});
  }
  if (wants(options, kParticles)) {
    if (options.particles.empty()) {
      report.notes.emplace_back("particles: no file is given (--particles FILE)");
    } else {
      Subject subject = subjectOfFile(options.particles);
      const DensitySurface surface(subject.particles.positions, subject.particles.spacing);
      subject.surface = &surface;
      study(subject);
    }
  }
  std::vector<Row> paperRows;
  if (wants(options, kTables)) {
    options.tell("tables 1 and 2 of van der Laan et al. 2009");
    paperRows = paperTableRows(renderer, options, machine, report.notes);
  }

  for (const std::string& shape : shapesOf(rows)) {
    report.documents.push_back({normalPlotName(shape), smoothingPlot(rows, shape, "normal_error_rms_deg",
                                                                     "error of normals, ° RMS", machine)});
    report.documents.push_back({depthPlotName(shape), smoothingPlot(rows, shape, "depth_rmse_unbiased_spacings",
                                                                    "error of depth, d RMS", machine)});
  }
  report.documents.push_back({"smoothing.md", smoothingPage(rows, paperRows, report.notes, machine, options.quick)});
  if (!rows.empty()) report.tables.push_back({"smoothing", std::move(rows)});
  if (!paperRows.empty()) report.tables.push_back({"smoothing_tables", std::move(paperRows)});
  return report;
}

}  // namespace sluice::evaluate
