#include "app/print/slicer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "app/io/text_pattern.hpp"
#include "app/print/format/zip_text.hpp"
#include "model/base/box.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr double margin_mm = 50;  // mm around a sheet on the slicer's bed: room for skirts and brims

class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = (fs::temp_directory_path() / "kinetix-slice-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("slicer: no temporary folder can be made");
    path_ = pattern;
  }
  ~WorkFolder() { fs::remove_all(path_, ignored_); }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
  std::error_code ignored_;
};

using Clock = std::chrono::steady_clock;

enum class Ended { well, badly, not_there, too_late };

constexpr std::chrono::milliseconds between_looks{20};  // ms: short beside the least time of a slicer, 0.2 s

/// Waits for a child process. It is ended at the deadline. @return its status; empty: too late
std::optional<int> wait_for(pid_t child, Clock::time_point deadline) {
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return -1;
    if (Clock::now() >= deadline) break;
    std::this_thread::sleep_for(between_looks);
  }
  kill(child, SIGKILL);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return std::nullopt;
}

/// Runs a program without a shell, and with nothing on the streams of this program.
Ended run(std::vector<std::string> words, Clock::time_point deadline) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return Ended::not_there;
  const std::optional<int> status = wait_for(child, deadline);
  if (!status) return Ended::too_late;
  return WIFEXITED(*status) && WEXITSTATUS(*status) == 0 ? Ended::well : Ended::badly;
}

std::string bed_settings(const model::Polyhedron& solid) {
  const Eigen::Vector3d size = model::box_of(solid.points).sizes();
  const double x = std::ceil(size.x() + 2 * margin_mm), y = std::ceil(size.y() + 2 * margin_mm);
  return fmt::format(
      "bed_shape = 0x0,{0}x0,{0}x{1},0x{1}\nmax_print_height = {2}\ndisplay_width = {0}\ndisplay_height = "
      "{1}\ndisplay_pixels_x = {0}\ndisplay_pixels_y = {1}\n",
      x, y, std::ceil(size.z() + margin_mm));
}

/// Returns settings with two extruders, as in the 3MF file.
std::string fdm_settings(bool supports) {
  return fmt::format(R"(printer_technology = FFF
nozzle_diameter = 0.4,0.4
filament_diameter = 1.75,1.75
extrusion_multiplier = 1,1
temperature = 210,210
first_layer_temperature = 210,210
layer_height = 0.2
first_layer_height = 0.2
elefant_foot_compensation = 0
wipe_tower = 0
support_material = {}
)",
                     supports ? 1 : 0);
}

// The time in which a layer hardens is PrusaSlicer's default.
constexpr const char* sla_settings = R"(printer_technology = SLA
layer_height = 0.05
initial_layer_height = 0.05
supports_enable = 0
pad_enable = 0
elefant_foot_compensation = 0
)";

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

double number_of(const std::string& text, const char* pattern) {
  const std::vector<std::string> match = first_match(text, pattern);
  return match.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(match[1]);
}

SliceEstimate read_gcode(const std::string& text) {
  SliceEstimate out;
  const auto time = first_match(text, R"(; estimated printing time \(normal mode\) = (.*))");
  out.seconds = time.empty() ? std::numeric_limits<double>::quiet_NaN() : seconds_of(time[1]);
  const auto used = first_match(text, R"(; filament used \[cm3\] = (.*))");
  if (used.empty()) return out;
  for (const std::string& each : all_matches(used[1], R"([0-9.]+)"))
    out.material_mm3 += mm3_per_cm3 * std::stod(each);
  return out;
}

SliceEstimate read_slices(const std::string& file) {
  const std::string text = text_in_zip(file, "config.ini");
  SliceEstimate out;
  out.seconds = number_of(text, R"(printTime = ([0-9.]+))");
  out.material_mm3 = mm3_per_cm3 * number_of(text, R"(usedMaterial = ([0-9.]+))");
  return out;
}

/// A slicer, and how long it may take.
struct SlicerProgram {
  std::string name;
  double limit_s;
  Clock::time_point deadline;
};

/// One run of a slicer, with the reader of its output.
struct Slicing {
  std::string settings, input;
  const char* action;
  const char* output;
  SliceEstimate (*read)(const std::string& file);
};

SlicerAnswer sliced(const WorkFolder& folder, const SlicerProgram& program, const Slicing& slicing) {
  write_file(folder / "settings.ini", slicing.settings);
  const std::string output = folder / slicing.output;
  const Ended ended =
      run({program.name, slicing.action, "--load", folder / "settings.ini", slicing.input, "-o", output},
          program.deadline);
  if (ended == Ended::not_there) return {{}, "no slicer found: " + program.name + " is not on PATH"};
  if (ended == Ended::badly) return {{}, program.name + " gave up"};
  if (ended == Ended::too_late)
    return {{},
            fmt::format("{} was ended after {:g} s: open the 3MF file (--format 3mf) in the slicer itself, "
                        "which shows time and material",
                        program.name, program.limit_s)};
  const SliceEstimate estimate = slicing.read(output);
  if (!(estimate.seconds > 0) || !(estimate.material_mm3 > 0))
    return {{}, program.name + " reported neither time nor material"};
  return {estimate};
}

/// Slices one print after the other. Time and material are those of all prints.
SlicerAnswer all_sliced(const WorkFolder& folder, const SlicerProgram& program,
                        const std::vector<Slicing>& prints) {
  SlicerAnswer sum{SliceEstimate{.prints = 0}};
  for (const Slicing& print : prints) {
    const SlicerAnswer one = sliced(folder, program, print);
    if (!one.estimate) return one;
    sum.estimate->seconds += one.estimate->seconds;
    sum.estimate->material_mm3 += one.estimate->material_mm3;
    ++sum.estimate->prints;
  }
  return sum;
}

/// Slices for FDM. Loose rods lie on the bed and need no supports.
SlicerAnswer sliced_fdm(PrintJob job, const WorkFolder& folder, const SlicerProgram& program) {
  job.slicer = Slicer::prusa;  // whichever slicer the files are for
  const bool supports = plan_supports(job).is_needed;
  const std::string sheet = job.sheet.name + ".3mf", rods = job.sheet.name + "_rods.3mf";
  std::vector<Slicing> prints;
  for (const auto& [name, content] : threemf_format.write(job)) {
    if (name != sheet && name != rods) continue;
    const bool is_sheet = name == sheet;
    const std::string file = folder / (is_sheet ? "sheet.3mf" : "rods.3mf");
    write_file(file, content);
    prints.push_back({bed_settings(is_sheet ? hard_part(job) : laid_out_rods(job.sheet)) +
                          fdm_settings(supports && is_sheet),
                      file, "--export-gcode", "sheet.gcode",
                      [](const std::string& gcode) { return read_gcode(text_of(gcode)); }});
  }
  SlicerAnswer out = all_sliced(folder, program, prints);
  if (out.estimate) out.estimate->supports = supports;
  return out;
}

/// Slices for SLA. Hard and soft parts are a print each, and so are loose rods. Supports of SLA take PrusaSlicer long.
SlicerAnswer sliced_sla(const PrintJob& job, const WorkFolder& folder, const SlicerProgram& program) {
  std::vector<Slicing> prints;
  for (const auto& [name, content] : stl_format.write(job)) {
    if (name != "hard.stl" && name != "soft.stl" && name != "rods.stl") continue;
    write_file(folder / name, content);
    prints.push_back(
        {bed_settings(name == "rods.stl" ? laid_out_rods(job.sheet) : hard_part(job)) + sla_settings,
         folder / name, "--export-sla", "sheet.sl1", read_slices});
  }
  SlicerAnswer out = all_sliced(folder, program, prints);
  if (out.estimate) out.estimate->lacks_supports = plan_supports(job).is_needed;
  return out;
}

}  // namespace

double seconds_of(std::string_view text) {
  const auto parts = first_match(text, R"(^(?:(\d+)d)? ?(?:(\d+)h)? ?(?:(\d+)m)? ?(?:(\d+)s)?\s*$)");
  if (text.empty() || parts.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double units[] = {86400, 3600, 60, 1};  // seconds
  double sum = 0;
  for (int k = 0; k < 4; ++k)
    if (!parts[k + 1].empty()) sum += units[k] * std::stod(parts[k + 1]);
  return sum;
}

SlicerAnswer estimate_by_slicer(const PrintJob& job, const std::string& name, double limit_s) {
  const std::string& process = job.sheet.process.name;
  if (process != "fdm" && process != "sla") return {{}, "no slicer found for " + process};
  const WorkFolder folder;
  const SlicerProgram program{
      name, limit_s,
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s))};
  return process == "fdm" ? sliced_fdm(job, folder, program) : sliced_sla(job, folder, program);
}

}  // namespace kinetix::app
