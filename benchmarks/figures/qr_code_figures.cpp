#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "model/base/parallel_runs.hpp"
#include "targets/display/image_goal.hpp"
#include "tests/support/qr_reader.hpp"
#include "tests/support/recogniser.hpp"

namespace kinetix::bench {
namespace {

constexpr int modules = 25;  // of a code of version 1 with a margin of two modules
// Any five that a code of version 1 holds.
constexpr const char* texts[] = {"KINETIX", "HELLO WORLD", "HTTP://KX.IO/42", "0123456789", "FOLD ME"};

struct Reading {
  int exact = 0, pressed = 0, before = 0;
  double seconds = 0, load = 0;
};

Reading read(const std::string& text, int cells_per_module, bool in_equilibrium) {
  const testing::TemporaryFolder folder;
  const int side = modules * cells_per_module;
  app::DisplayFile file;
  file.name = "code";
  file.goal = targets::image_goal(testing::draw_qr_code(text, folder.path("code.png")),
                                  targets::PanelSize{side, side}, targets::ImageLevels::two, true);
  file.offset = 0.06;
  const auto goal = make_goal(file);
  app::Run run;
  app::RunOptions options;
  options.verify = false;
  if (in_equilibrium)
    run = run_goal(*goal, options);
  else
    static_cast<app::SearchResult&>(run) = goal->search(options);
  const app::FarViewOptions view =
      testing::as_ink_on_paper(app::far_view_options(file.goal), !file.goal.inverted);
  const auto seen = [&](const model::State& state) {
    return testing::read_qr_code(far_view(run.design.structure, state, view)) == text;
  };
  const auto& display = app::outcome_of<app::DisplayOutcome>(run);
  Reading out;
  out.exact = seen(display.design.view.state);
  out.before = seen(rest_state(run.design.structure));
  out.seconds = run.timings.optimise;
  if (!in_equilibrium) return out;
  out.pressed = seen(run.states.front().poses);
  out.load = run.equilibrium->path.steps.back().load;
  return out;
}

}  // namespace

std::vector<Figure> qr_code_figures() {
  constexpr int codes = std::size(texts);
  std::vector<Reading> each(2 * codes);
  each[0] = read(texts[0], 4, true);  // alone, since its time is measured
  model::run_in_parallel(2 * codes - 1, 0, [&](int k) {
    each[k + 1] = k + 1 < codes ? read(texts[k + 1], 4, true) : read(texts[k + 1 - codes], 3, false);
  });
  Reading all;
  for (int k = 0; k < codes; ++k) {
    all.exact += each[k].exact;
    all.pressed += each[k].pressed;
    all.before += each[k].before;
    all.load = std::max(all.load, each[k].load);
  }
  int at_three = 0;
  for (int k = 0; k < codes; ++k) at_three += each[codes + k].exact;
  return {{"QR codes of version 1, four cells a module (100 x 100), offset <= 0.06 cells, five texts",
           "read by zbar from the exact state and from the equilibrium, not before; search <= 10 s",
           fmt::format("{} and {} of 5 read, {} before; search of the first {:.1f} s, {:.1f} N", all.exact,
                       all.pressed, all.before, each[0].seconds, all.load),
           all.exact == 5 && all.pressed == 5 && all.before == 0 && each[0].seconds <= 10},
          {"the same, three cells a module (75 x 75)", "tried",
           fmt::format("{} of 5 read from the exact state", at_three), true}};
}

}  // namespace kinetix::bench
