#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/linkage/state.hpp"
#include "sim/live_sheet.hpp"
#include "tests/app/studio/client.hpp"
#include "tests/app/studio/studio.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::bench {
namespace {

using Clock = std::chrono::steady_clock;
using testing::Client;
using testing::OpenStudio;
using testing::Received;

const char* const shapes = KINETIX_SHAPES;
constexpr int drags = 100;                   // of each series: enough for a 95th percentile
constexpr double sleep_s = 10, watch_s = 5;  // how long a page sleeps, and is watched

app::Design searched(const std::string& name) {
  const app::Run run =
      run_goal(*app::read_target(std::string(shapes) + "/" + name + ".yaml").goal, {.verify = false});
  app::Design design;
  design.name = run.design.name;
  design.structure = run.design.structure;
  design.theta = run.theta;
  return design;
}

double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

double share(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

Figure within(const std::string& what, double most, double measured, const char* unit) {
  return {what, fmt::format("at most {:g} {}", most, unit), fmt::format("{:.3g} {}", measured, unit),
          measured <= most};
}

/// Page at the socket, in the live physics.
struct Page {
  explicit Page(const app::Design& design) : studio(design), client(studio.port()) {
    client.open(studio.token);
    client.text("design");
    last = client.ask({{"type", "mode"}, {"mode", "bullet"}});
  }

  Received drag(int body, const Eigen::Vector3d& to) {
    return last = client.ask({{"type", "drag"}, {"body", body}, {"to", {to.x(), to.y(), to.z()}}});
  }
  Eigen::Vector3d place(int body) const {
    return {last.pose(body)[0], last.pose(body)[1], last.pose(body)[2]};
  }
  Received frame() {
    for (;;) {
      Received next = client.receive();
      if (next.closed) return next;
      if (next.frame.empty()) continue;
      client.acknowledge(next);
      return last = next;
    }
  }

  OpenStudio studio;
  Client client;
  Received last;
};

/// Returns frames and simulated seconds per second while a body is dragged to and fro.
std::array<double, 2> pace(Page& page, int body) {
  const Eigen::Vector3d from = page.place(body);
  page.drag(body, from + Eigen::Vector3d(0, 5, 10));
  const double start = now_s(), simulated = page.frame().head(4);
  int frames = 0;
  while (now_s() - start < watch_s) page.frame(), ++frames;
  const double took = now_s() - start;
  return {frames / took, (page.last.head(4) - simulated) / took};
}

void add_drags(std::vector<Figure>& figures, Page& page) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> way(-15, 15);  // mm
  std::vector<double> waits;
  const int bodies = static_cast<int>(page.last.head(9));
  for (int k = 0; k < drags; ++k) {
    const int body = static_cast<int>(random() % static_cast<unsigned>(bodies));
    const Eigen::Vector3d to = page.place(body) + Eigen::Vector3d(way(random), way(random), way(random));
    waits.push_back(1000 * seconds([&] { page.drag(body, to); }));
  }
  figures.push_back(within("rib of 82 bodies: drag to the first frame with its effect, median", 50,
                           share(waits, 0.5), "ms"));
  figures.push_back(within("likewise, 95 of 100", 100, share(waits, 0.95), "ms"));
}

/// Measures edits that give a column a tilt.
void add_edits(std::vector<Figure>& figures, Page& page, const model::Lattice& sheet) {
  const model::Structure& structure = *sheet.squares();
  const model::Wall front{{9, 0}, model::Axis::x}, back{{9, 1}, model::Axis::x};
  std::vector<double> waits;
  for (int k = 0; k < drags; ++k)
    waits.push_back(1000 * seconds([&] {
                      page.client.ask({{"type", "hinge"},
                                       {"indices", {*structure.hinge_at(front), *structure.hinge_at(back)}},
                                       {"beta_deg", 5 + 0.1 * k},
                                       {"alternate", true}});
                    }));
  figures.push_back(within("edited tilt, 40 columns: new motion, 95 of 100", 100, share(waits, 0.95), "ms"));
}

/// Returns the simulated seconds by which the first frame after a sleep lags behind the clock.
double age_after_sleep(Page& page) {
  page.drag(40, page.place(40) + Eigen::Vector3d(0, 0, 5));
  const double start = now_s(), simulated = page.frame().head(4);
  std::vector<Received> unread;
  while (now_s() - start < sleep_s) {
    const Received next = page.client.receive(std::chrono::milliseconds(200));
    if (!next.frame.empty()) unread.push_back(next);
  }
  for (const Received& one : unread) page.client.acknowledge(one);
  const Received first = page.frame();
  return (now_s() - start) - (first.head(4) - simulated);
}

/// Result of random drags of a curled strip.
struct Drags {
  bool is_finite = true, grows = false;
  double off_family = 0;  ///< distance from the family two seconds after the last drag, cell edges
};

Drags random_drags(unsigned seed, double drags_s) {
  auto strip = model::ExactDesign<double>::basic(8, 1);
  for (int c = 0; c < 8; ++c) strip.beta[c] = (c % 2 == 0 ? 0.5 : -0.5);
  const model::Structure structure = sheet_of(strip, {});
  const model::Linkage linkage = structure;
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 240;  // of the studio
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-60, 60);  // mm
  sim::LiveSheet sheet(linkage, options, 1000);
  Drags out;
  while (sheet.seconds() < drags_s) {
    const int body = static_cast<int>(random() % linkage.bodies.size());
    sheet.drag(body, linkage.rest_position(body), {place(random), place(random), place(random)});
    for (int k = 0; k < 96; ++k) sheet.step();
    sheet.release();
    double energy = sheet.energy();
    for (int k = 0; k < 48; ++k) {
      sheet.step();
      out.grows |= !(sheet.energy() <= energy * (1 + 1e-9));
      energy = sheet.energy();
    }
    out.is_finite &= model::is_finite(sheet.state());
  }
  for (int k = 0; k < 480; ++k) sheet.step();
  const model::State& state = sheet.state();
  const double theta = mean_theta(linkage, state);
  out.off_family = aligned_distance(linkage, state, exact_motion(structure).at(theta)).max;
  return out;
}

void add_random_drags(std::vector<Figure>& figures) {
  std::vector<Drags> seeds(100);
  model::run_in_parallel(static_cast<int>(seeds.size()), 0,
                         [&](int k) { seeds[k] = random_drags(static_cast<unsigned>(k), 60); });
  int not_finite = 0, grown = 0;
  double off_family = 0;
  for (const Drags& one : seeds) {
    not_finite += !one.is_finite;
    grown += one.grows;
    off_family = std::max(off_family, one.off_family);
  }
  figures.push_back({"60 s of random drags, 100 seeds: runs with a NaN; that gain energy without a hand",
                     "0; 0", fmt::format("{}; {}", not_finite, grown), not_finite + grown == 0});
  figures.push_back(
      within("likewise: off the family 2 s after the last drag, largest", 1e-3, off_family, "cell edges"));
}

/// Returns the output of a script of tests/viewer, in a browser with software rendering.
std::string in_browser(const std::string& script) {
  const testing::TemporaryFolder folder;
  const std::string command =
      fmt::format("KINETIX_OPT={} KINETIX_SHAPES={} {}/tests/viewer/with_packages.sh {} ON {} 2>&1",
                  KINETIX_OPT, shapes, KINETIX_SOURCE, folder.path("page"), script);
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string out;
  char buffer[4096];
  while (const std::size_t read = fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, read);
  pclose(pipe);
  return out;
}

/// Returns the number after a word in a script's output; empty if the script did not reach it.
std::optional<double> number_after(const std::string& word, const std::string& said) {
  const auto at = said.find(word);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(said.substr(at + word.size()));
}

/// Returns the figure; without a number it reports the reason instead.
Figure unless_missing(Figure figure, const std::optional<double>& measured, const std::string& said) {
  if (!measured) figure.measured = "not measured: " + said.substr(0, said.find('\n')), figure.met = false;
  return figure;
}

void add_pages(std::vector<Figure>& figures) {
  const std::string said = in_browser("frame_rate");
  const auto frames = number_after("drawn: ", said), drag = number_after("dragged: ", said),
             picture = number_after("pictured: ", said), slide = number_after("slid: ", said),
             size = number_after("written: ", said);
  figures.push_back(unless_missing(
      {"helmet of 844 bodies: frames a second that a page draws in the live physics, software rendering",
       "at least 15", fmt::format("{:.0f}", frames.value_or(0)), frames.value_or(0) >= 15},
      frames, said));
  figures.push_back(
      unless_missing(within("rib of 82 bodies: drag to the picture of its effect in the browser, 95 of 100",
                            150, drag.value_or(0), "ms"),
                     drag, said));
  figures.push_back(
      unless_missing(within("helmet of 844 bodies: from opening its report to the first picture", 1500,
                            picture.value_or(0), "ms"),
                     picture, said));
  figures.push_back(
      unless_missing(within("helmet of 844 bodies: script of a step of its report's slider, longest of 31",
                            16, slide.value_or(0), "ms"),
                     slide, said));
  figures.push_back(unless_missing(
      within("size of a report, the larger of helmet's and rib's", 1.2, size.value_or(0), "MB"), size, said));
}

}  // namespace

std::vector<Figure> studio_figures() {
  std::vector<Figure> figures;
  const app::Design rib = searched("helmet_rib");
  {
    Page page(rib);
    add_drags(figures, page);
    const double real = pace(page, 80)[1];
    figures.push_back({"rib: simulated seconds a second, with a drag on", "at least 1",
                       fmt::format("{:.2f}", real), real >= 0.99});
    figures.push_back(within("rib: age of the next frame after 10 s asleep", 100,
                             1000 * std::max(0.0, age_after_sleep(page)), "ms"));
  }
  {
    Page page(rib);
    page.client.ask({{"type", "mode"}, {"mode", "exact"}});
    add_edits(figures, page, rib.structure);
  }
  {
    Page page(searched("headform"));
    const double frames = pace(page, 400)[0];
    figures.push_back({"helmet of 844 bodies: frames a second at the socket, with a drag on", "at least 20",
                       fmt::format("{:.0f}", frames), frames >= 20});
  }
  add_pages(figures);
  add_random_drags(figures);
  return figures;
}

}  // namespace kinetix::bench
