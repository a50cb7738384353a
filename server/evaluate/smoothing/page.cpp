#include "smoothing/page.h"

#include <algorithm>

#include "scatter_plot.h"

namespace sluice::evaluate {

namespace {

using Columns = std::vector<std::pair<std::string, std::string>>;

std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

PlotSeries::Fill fillOf(double scale) {
  if (scale >= 1) return PlotSeries::Fill::Solid;
  return scale >= 0.5 ? PlotSeries::Fill::Ring : PlotSeries::Fill::Dot;
}

bool isRaw(const Row& row) { return row.text("method") == "none"; }

std::vector<Row> rowsOf(const std::vector<Row>& rows, const std::string& shape) {
  std::vector<Row> result;
  std::ranges::copy_if(rows, std::back_inserter(result), [&](const Row& row) { return row.text("shape") == shape; });
  return result;
}

std::string title(const Row& row) {
  return words(row.text("method")) + ", T = " + shortText(row.number("strength")) + " d², resolution × " +
         shortText(row.number("scale"));
}

/// The rows that the default strength gives at full resolution: raw splats first, then by error.
std::vector<Row> atDefaultStrength(const std::vector<Row>& rows, double strength) {
  std::vector<Row> result;
  for (const Row& row : rows) {
    if (row.number("scale") == 1 && (isRaw(row) || row.number("strength") == strength)) result.push_back(row);
  }
  std::ranges::stable_sort(result, [](const Row& a, const Row& b) {
    return a.number("normal_error_rms_deg") < b.number("normal_error_rms_deg");
  });
  return result;
}

/// The rows that none of the same shape beats in both time and error of normals.
std::vector<Row> bestRows(const std::vector<Row>& rows) {
  std::vector<PlotPoint> points;
  for (const Row& row : rows) {
    if (!isRaw(row)) points.push_back({row.number("milliseconds_median"), row.number("normal_error_rms_deg"), {}});
  }
  std::vector<Row> result;
  for (const PlotPoint& best : paretoFront(points)) {
    const auto found = std::ranges::find_if(rows, [&](const Row& row) {
      return !isRaw(row) && row.number("milliseconds_median") == best.x && row.number("normal_error_rms_deg") == best.y;
    });
    result.push_back(*found);
  }
  return result;
}

}  // namespace

std::vector<std::string> shapesOf(const std::vector<Row>& rows) {
  std::vector<std::string> shapes;
  for (const Row& row : rows) {
    if (std::ranges::find(shapes, row.text("shape")) == shapes.end()) shapes.push_back(row.text("shape"));
  }
  return shapes;
}

std::string normalPlotName(const std::string& shape) { return "smoothing_" + shape + "_normals.svg"; }
std::string depthPlotName(const std::string& shape) { return "smoothing_" + shape + "_depth.svg"; }

std::string smoothingPlot(const std::vector<Row>& rows, const std::string& shape, const std::string& errorKey,
                          const std::string& errorLabel, const std::string& machine) {
  ScatterPlot plot;
  plot.title = words(shape) + ": " + errorLabel + " against time";
  plot.subtitle = machine;
  plot.xLabel = "smoothing, ms (median)";
  plot.yLabel = errorLabel;
  plot.paretoFront = true;
  plot.fillKey = {"full resolution", "half", "quarter"};
  std::vector<std::string> methods;
  for (const Row& row : rowsOf(rows, shape)) {
    if (isRaw(row)) {
      if (row.number("scale") == 1) {
        plot.level = row.number(errorKey);
        plot.levelLabel = "raw splats";
      }
      continue;
    }
    const std::string method = row.text("method");
    auto kind = std::ranges::find(methods, method);
    if (kind == methods.end()) kind = methods.insert(methods.end(), method);
    const int colour = static_cast<int>(kind - methods.begin());
    const PlotSeries::Fill fill = fillOf(row.number("scale"));
    auto series =
        std::ranges::find_if(plot.series, [&](const PlotSeries& s) { return s.colour == colour && s.fill == fill; });
    if (series == plot.series.end()) {
      PlotSeries added;
      added.name = words(method);
      added.label = row.number("scale") == 1 ? added.name : "";
      added.colour = colour;
      added.fill = fill;
      plot.series.push_back(std::move(added));
      series = plot.series.end() - 1;
    }
    series->points.push_back({row.number("milliseconds_median"), row.number(errorKey), title(row)});
  }
  return drawSvg(plot);
}

std::string smoothingPage(const std::vector<Row>& rows, const std::vector<Row>& paperRows,
                          const std::vector<std::string>& notes, const std::string& machine, bool quick) {
  std::string text = "# Smoothing: error against time\n\nMeasured on " + machine + "; medians of 5 frames.";
  text += quick ? " A quick run: fewer shapes and strengths, at 256×256.\n" : "\n";
  if (!rows.empty()) {
    text +=
        "\nShapes are filled with particles d = 0.1 m apart, jittered by up to d/4, drawn as spheres of 0.8 d and "
        "smoothed. Errors are of the smoothed surface against the exact one: normals where the surface is seen at "
        "a cosine above 0.3 and 12 pixels inside its outline; depth along the true normal, without its median, "
        "which is how much splats are larger than particles; flicker is how far normals turn when the camera "
        "turns by 0.1°. T is the smoothing time, the same amount of smoothing for every method.\n";
  }
  for (const std::string& shape : shapesOf(rows)) {
    const std::vector<Row> ofShape = rowsOf(rows, shape);
    double strength = 0;
    for (const Row& row : ofShape) {
      if (row.flag("is_default")) strength = row.number("strength");
    }
    text += "\n## " + words(shape) + "\n\n![Error of normals against time](" + normalPlotName(shape) +
            ")\n\n![Error of depth against time](" + depthPlotName(shape) + ")\n\nAt T = " + shortText(strength) +
            " d², full resolution, best normals first:\n\n";
    const Columns columns{{"method", "method"},
                          {"milliseconds_median", "ms"},
                          {"passes", "passes"},
                          {"normal_error_rms_deg", "normals RMS °"},
                          {"normal_error_p95_deg", "95 % °"},
                          {"depth_rmse_unbiased_spacings", "depth RMS d"},
                          {"curvature_residual", "curvature · d"},
                          {"silhouette_iou", "outline IoU"},
                          {"hausdorff_px", "outline px"},
                          {"holes", "holes"},
                          {"flicker", "flicker °"}};
    text += toMarkdown(atDefaultStrength(ofShape, strength), columns);
    text += "\nNothing measured is both faster and better than:\n\n";
    const Columns front{{"method", "method"},
                        {"strength", "T d²"},
                        {"scale", "resolution ×"},
                        {"milliseconds_median", "ms"},
                        {"normal_error_rms_deg", "normals RMS °"},
                        {"depth_rmse_unbiased_spacings", "depth RMS d"},
                        {"flicker", "flicker °"}};
    text += toMarkdown(bestRows(ofShape), front);
  }
  if (!paperRows.empty()) {
    text +=
        "\n## Tables 1 and 2 of van der Laan, Green & Sainz 2009\n\nWhole frames of 64,000 particles at 1024×768; "
        "theirs on a GeForce 8800 GTS in 2009, ours on " +
        machine + " (table 0: the default look).\n\n";
    const Columns columns{{"table", "table"},
                          {"dataset", "their scene"},
                          {"setting", "setting"},
                          {"method", "our method"},
                          {"iterations_run", "passes"},
                          {"paper_milliseconds", "theirs ms"},
                          {"frame_milliseconds_median", "ours ms"},
                          {"smoothing_milliseconds_median", "of it smoothing ms"}};
    text += toMarkdown(paperRows, columns);
  }
  if (!notes.empty()) text += "\n## Left out\n\n";
  for (const std::string& note : notes) text += "- " + note + "\n";
  return text;
}

}  // namespace sluice::evaluate
