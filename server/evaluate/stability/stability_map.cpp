#include "stability/stability_map.h"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "stability/stiffness_cases.h"

namespace sluice::evaluate {

namespace {

// Of the picture, in SVG's pixels.
constexpr double kCellWidth = 34;
constexpr double kCellHeight = 26;
constexpr double kLeft = 92;
constexpr double kTop = 104;
constexpr double kBetween = 26;
constexpr double kBelow = 96;        ///< Ticks, the label of the axis and the legend.
constexpr double kLeastWidth = 660;  ///< Of the legend.

/// How a fate is drawn: a colour of Okabe & Ito 2008, and a sign for those who tell no colours apart.
struct Sign {
  const char* word;
  const char* colour;
  const char* sign;
  const char* meaning;
};
constexpr std::array kSigns{Sign{"stable", "#009e73", "", "stable"},
                            Sign{"recovered", "#56b4e9", "↓", "recovered by smaller steps"},
                            Sign{"stopped", "#e69f00", "■", "stopped, with a message"},
                            Sign{"bursts", "#d55e00", "×", "bursts"}, Sign{"not finite", "#000000", "!", "not finite"}};

const Sign& signOf(const std::string& word) {
  const auto found = std::ranges::find_if(kSigns, [&](const Sign& sign) { return sign.word == word; });
  return found == kSigns.end() ? kSigns.back() : *found;
}

constexpr const char* kStyle = R"(<style>
text{font-family:system-ui,-apple-system,"Segoe UI",Helvetica,Arial,sans-serif;font-size:12px;fill:#24292f}
.title{font-size:17px;font-weight:600}.quiet{fill:#57606a}.solver{font-weight:600}.paper{fill:#ffffff}
.cell{stroke:#ffffff;stroke-width:2}.sign{fill:#ffffff;font-size:14px;font-weight:700}
@media (prefers-color-scheme:dark){text{fill:#e6edf3}.quiet{fill:#9aa4af}.paper{fill:#0d1117}.cell{stroke:#0d1117}.sign{fill:#0d1117}}
</style>
)";

class MapDrawing {
 public:
  MapDrawing(const std::vector<Row>& rows, std::string subtitle) : rows_(rows), subtitle_(std::move(subtitle)) {
    for (const Row& row : rows) {
      heights_.insert(row.number("layers"));
      steps_.insert(row.number("step"));
      if (std::ranges::find(solvers_, row.text("solver")) == solvers_.end()) solvers_.push_back(row.text("solver"));
    }
  }

  std::string draw() {
    const double field = fieldWidth() + kBetween;
    const double width = std::max(kLeft + field * static_cast<double>(solvers_.size()), kLeastWidth);
    const double height = bottom() + kBelow;
    out_ << R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" << width << ' ' << height << "\" width=\""
         << width << "\" height=\"" << height << "\" role=\"img\">\n<title>Columns at rest</title>\n"
         << kStyle << "<rect class=\"paper\" width=\"" << width << "\" height=\"" << height << "\" rx=\"8\"/>\n";
    text(20, 32, "Columns at rest: what each solver bears", "title");
    text(20, 54, subtitle_ + "; steps forced past the bounds that simulations keep to", "quiet");
    std::ostringstream turn;
    turn << " transform=\"rotate(-90 22 " << 0.5 * (kTop + bottom()) << ")\"";
    text(22, 0.5 * (kTop + bottom()), "step, ms", "axis", "middle", turn.str());
    for (const double step : steps_) text(kLeft - 8, atStep(step) + 17, shortText(1e3 * step), "quiet", "end");
    for (std::size_t k = 0; k < solvers_.size(); ++k) drawField(solvers_[k], kLeft + field * static_cast<double>(k));
    text(kLeft, bottom() + 40, "layers of particles 0.02 m apart: the higher, the stiffer", "axis");
    drawLegend();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  double fieldWidth() const { return kCellWidth * static_cast<double>(heights_.size()); }
  double bottom() const { return kTop + kCellHeight * static_cast<double>(steps_.size()); }
  /// Top of a step's cells: the longest step first.
  double atStep(double step) const {
    return bottom() - kCellHeight * static_cast<double>(std::distance(steps_.begin(), steps_.find(step)) + 1);
  }

  void text(double x, double y, const std::string& content, const char* style, const char* anchor = "start",
            const std::string& extra = "") {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" class=\"" << style << "\" text-anchor=\"" << anchor << '"'
         << extra << '>' << content << "</text>\n";
  }

  void cell(double x, double y, const Sign& sign, const std::string& title) {
    out_ << "<rect class=\"cell\" x=\"" << x << "\" y=\"" << y << "\" width=\"" << kCellWidth << "\" height=\""
         << kCellHeight << "\" fill=\"" << sign.colour << "\">";
    if (!title.empty()) out_ << "<title>" << title << "</title>";
    out_ << "</rect>\n";
    if (*sign.sign != '\0') text(x + 0.5 * kCellWidth, y + 0.5 * kCellHeight + 5, sign.sign, "sign", "middle");
  }

  void drawField(const std::string& solver, double left) {
    text(left + 0.5 * fieldWidth(), kTop - 12, solver, "solver", "middle");
    for (const double layers : heights_) {
      text(atHeight(left, layers) + 0.5 * kCellWidth, bottom() + 17, shortText(layers), "quiet", "middle");
    }
    for (const Row& row : rows_) {
      if (row.text("solver") != solver) continue;
      const std::string& word = row.text("outcome");
      cell(atHeight(left, row.number("layers")), atStep(row.number("step")), signOf(word),
           shortText(row.number("layers")) + " layers, " + shortText(1e3 * row.number("step")) + " ms: " + word);
    }
  }

  double atHeight(double left, double layers) const {
    return left + kCellWidth * static_cast<double>(std::distance(heights_.begin(), heights_.find(layers)));
  }

  void drawLegend() {
    double x = 20;
    const double y = bottom() + 58;
    for (const Sign& sign : kSigns) {
      const bool present = std::ranges::any_of(rows_, [&](const Row& row) { return row.text("outcome") == sign.word; });
      if (!present) continue;
      cell(x, y, sign, "");
      text(x + kCellWidth + 7, y + 17, sign.meaning, "key");
      x += kCellWidth + 24 + 6.4 * static_cast<double>(std::string(sign.meaning).size());  // of a letter at 12 px
    }
  }

  const std::vector<Row>& rows_;
  std::string subtitle_;
  std::set<double> heights_;
  std::set<double> steps_;
  std::vector<std::string> solvers_;
  std::ostringstream out_;
};

}  // namespace

std::vector<StabilityJob> mapJobs(bool quick, int threads) {
  const std::vector<int> heights = quick ? std::vector<int>{10, 20, 40} : std::vector<int>{10, 20, 40, 80, 160};
  const std::vector<double> steps = quick ? std::vector<double>{5e-4, 2e-3, 8e-3}
                                          : std::vector<double>{1.25e-4, 2.5e-4, 5e-4, 1e-3, 2e-3, 4e-3, 8e-3};
  std::vector<StabilityJob> jobs;
  for (const int layers : heights) {
    for (const double step : steps) {
      for (const Method& method : solverMethods(true)) {
        const std::string name =
            "map: " + std::to_string(layers) + " layers, steps of " + shortText(1e3 * step) + " ms";
        jobs.push_back({name + ", " + method.solver(), [=]() -> std::vector<Row> {
                          Trial trial = column(layers);
                          trial.experiment.forcedStep = step;
                          trial.seconds = 0.25;
                          trial.steps = 2000;
                          const SolverOutcome outcome = attempt(trial, method, threads);
                          // Steps are forced to find out where the limits are: a burst is one, no failure.
                          Row row = toRow(name, method.solver(), outcome, outcome.fate != Fate::NotFinite);
                          row.set("layers", static_cast<double>(layers));
                          row.set("step", step);
                          return {row};
                        }});
      }
    }
  }
  return jobs;
}

std::string drawStabilityMap(const std::vector<Row>& rows, const std::string& subtitle) {
  return MapDrawing(rows, subtitle).draw();
}

}  // namespace sluice::evaluate
